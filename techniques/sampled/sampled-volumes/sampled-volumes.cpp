// N stencil shadow volumes over the light, averaged (Zápotocký 5.4: his soft shadow volumes, and with 1,000 samples and
// depth-fail the image that he takes for the truth). Each light sample's volumes are counted in the stencil buffer; its lit
// pixels are added up; the sum is divided by N. Nothing is sampled but the light: a pixel has exactly the visibility of its
// N light samples, and converges to the visible fraction of the light's area as N grows, at a cost that grows with N.
// Depth-pass, depth-fail and exclusive-or break where the hard shadows of these names do; they are the thesis's rows, so
// that depth-fail is what is shown, though a choice for each caster gives the same image for less. Departure: the thesis
// jitters a grid of samples at random; here they are those of sampled-maps.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/shared/sampling/light_points.h"
#include "techniques/volumes/stencil_volumes.h"

#include <memory>
#include <optional>

namespace shadowbench::techniques {
namespace {

VolumeTest testNamed(const std::string& name) {
    if (name == "zpass") return VolumeTest::DepthPass;
    if (name == "per-caster") return VolumeTest::PerCaster;
    return name == "xor" ? VolumeTest::ExclusiveOr : VolumeTest::DepthFail;
}

class SampledVolumes final : public Technique {
public:
    explicit SampledVolumes(const Parameters& p)
        : count_(p.integer("n")), pattern_(p.text("pattern")), volumes_(testNamed(p.text("test"))),
          add_(gl::Program::screen("sampled/sampled-volumes/add.frag")),
          mean_(gl::Program::screen("shared/sampling/mean.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!images_ || images_->sum.size() != frame.size) images_.emplace(frame.size);
        images_->sumTarget.clearColour(0, glm::vec4(0));
        for (const glm::dvec3& point : points(frame)) {
            drawSample(frame, point);
            addSample(frame);
        }
        mean_.set("sum", images_->sum).set("count", static_cast<float>(count_));
        resolve(frame, {&visibility}, mean_, "mean");
    }

    /// Sums over all samples.
    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        std::map<std::string, double> sums;
        for (const glm::dvec3& point : points(frame)) {
            drawSample(frame, point);
            for (const auto& [name, value] : volumes_.figures(frame.gbuffer.depthStencil())) sums[name] += value;
        }
        return sums;
    }

private:
    struct Images {
        explicit Images(glm::ivec2 size) : lit(gl::Format::R8, size), sum(gl::Format::R32F, size), sumTarget{&sum} {}
        gl::Texture lit; // from one sample
        gl::Texture sum;
        gl::RenderTarget sumTarget;
    };

    [[nodiscard]] std::vector<glm::dvec3> points(const Frame& frame) const {
        return lightPoints(frame.snapshot.light, pattern_, count_, frame.seed);
    }

    void drawSample(const Frame& frame, const glm::dvec3& point) const {
        volumes_.render(frame, glm::dvec4(point, 1), frame.gbuffer.depthStencil(), images_->lit);
    }

    void addSample(const Frame& frame) {
        const auto pass = frame.pass("light sum");
        add_.set("lit", images_->lit);
        images_->sumTarget.bind();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        add_.drawScreen();
        glDisable(GL_BLEND);
    }

    int count_;
    std::string pattern_;
    mutable StencilVolumes volumes_; // `figures` draws each sample's volumes again
    gl::Program add_, mean_;
    std::optional<Images> images_;
};

} // namespace

Entry sampledVolumes() {
    return {
        .id = "sampled-volumes",
        .title = "Sampled area light, stencil shadow volumes of each sample",
        .source = {Document::Zapotocky, "5.4"},
        .answer = Answer::Soft,
        .lacks = {Need::OpenMeshes},
        .parameters = {lightCountParameter("light samples, the volumes of all casters for each"),
                       lightPatternParameter(),
                       {"test", "zfail", OneOf{{"zfail", "zpass", "xor", "per-caster"}},
                        "how volumes are counted: as volume-zfail:test=zfail, volume-zpass, volume-xor or volume-zfail do",
                        "Zápotocký, Table 5.4; course, Everitt–Kilgard 3.4"}},
        .figures = volumeFigures(),
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<SampledVolumes>(p); }};
}

} // namespace shadowbench::techniques
