// N shadow maps over the light, averaged (Heckbert–Herf 1997): eq. 4.2 of the dissertation; Zápotocký's "sampled" methods.
// Converges to the visible fraction of the light's area as N grows; N samples give N − 1 levels between lit and umbra.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/sampling/light_points.h"

#include <optional>
#include <set>

namespace shadowbench::techniques {
namespace {

class SampledMaps final : public Technique {
public:
    explicit SampledMaps(const Parameters& p)
        : count_(p.integer("n")), pattern_(p.text("pattern")), map_(p.integer("map"), biasFrom(p), Lookup::Compare),
          test_(gl::Program::screen("shared/maps/single_map.frag")),
          mean_(gl::Program::screen("shared/sampling/mean.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!sum_ || sum_->size() != frame.size) sum_.emplace(gl::Format::R32F, frame.size);
        const gl::RenderTarget sumTarget({&*sum_});
        sumTarget.clearColour(0, glm::vec4(0));
        for (const glm::dvec3& point : lightPoints(frame.snapshot.light, pattern_, count_, frame.seed)) {
            const LightView light = fitFromSample(frame.snapshot.light, point, frame.snapshot);
            map_.draw(light, frame);
            addTest(frame, light, sumTarget);
        }
        mean_.set("sum", *sum_).set("count", static_cast<float>(count_));
        resolve(frame, {&visibility}, mean_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        const Image<float> sum = gl::RenderTarget({&*sum_}).readFloat(0);
        std::set<float> levels(sum.begin(), sum.end());
        levels.erase(0);
        levels.erase(static_cast<float>(count_));
        return {{"levels", static_cast<double>(levels.size())}};
    }

private:
    void addTest(const Frame& frame, const LightView& light, const gl::RenderTarget& sumTarget) {
        const auto pass = frame.pass("shadow test");
        test_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light))
            .set("depthMap", map_.texture());
        sumTarget.bind();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        test_.drawScreen();
        glDisable(GL_BLEND);
    }

    int count_;
    std::string pattern_;
    DepthMap map_;
    gl::Program test_, mean_;
    std::optional<gl::Texture> sum_;
};

} // namespace

Entry sampledMaps() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        lightCountParameter("light samples, one map each: 256 of a scene of 100,000 triangles take some seconds a frame"),
        lightPatternParameter(),
    });
    return {.id = "sampled-maps",
            .title = "Sampled area light, one shadow map a sample",
            .source = {Document::Dissertation, "2.3.5, eq. 4.2"},
            .answer = Answer::Soft,
            .parameters = std::move(parameters),
            .figures = {{"levels", "different visibilities in the image between umbra and light"}},
            .variants = {"", "n=256"},
            .make = [](const Parameters& p) { return std::make_unique<SampledMaps>(p); }};
}

} // namespace shadowbench::techniques
