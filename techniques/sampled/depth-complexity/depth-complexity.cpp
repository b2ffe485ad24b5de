// Soft shadows by depth complexity sampling (Forest, Barthe, Paulin 2008; dissertation 2.3.5, Figure 2.24):
// 1. the casters' edges that are silhouettes for some point of the light  2. hard shadow quads, which count the layers that
// hide the light's middle from each pixel's surface point  3. a penumbra wedge over each edge; for a point within, which
// sees whether layers end at the edge, a counter of each sample of the light learns whether they do so between it and the
// middle
// 4. the share of samples that no layer hides is visible. Casters that overlap are counted, not added, and silhouettes are
// the point's own, so that visibility is that of the samples. Cost grows with them and with the edges, many more than those
// of the middle's silhouettes.
// Departures: the documents at hand do not say where counting starts; here it starts at the light's middle, so that an edge
// counts only for points in its wedge. Counters are bytes of a buffer, changed atomically; they hold no more than 127 layers
// between a sample and the middle.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/shared/sampling/light_points.h"
#include "techniques/volumes/penumbra_wedges.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {
namespace {

class DepthComplexity final : public Technique {
public:
    explicit DepthComplexity(const Parameters& p)
        : count_(p.integer("n")), pattern_(p.text("pattern")),
          wedge_("volumes/wedge.vert", "sampled/depth-complexity/wedge.frag", samples()),
          resolve_(gl::Program::screen("sampled/depth-complexity/depth-complexity.frag", samples())) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!layers_ || layers_->size() != frame.size) layers_.emplace(gl::Format::R32F, frame.size);
        wedges_.build(frame, frame.snapshot.light);
        wedges_.countLayers(frame, *layers_);
        countSamples(frame);
        resolve_.set("layers", *layers_).set("width", frame.size.x);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override { return wedges_.count().figures(); }

private:
    [[nodiscard]] gl::Defines samples() const { return {{"SAMPLES", std::to_string(count_)}}; }

    void countSamples(const Frame& frame) {
        const auto pass = frame.pass("penumbra wedges");
        const Light& light = frame.snapshot.light;
        const glm::dmat4 toLight = unitLightFromWorld(light);
        std::vector<glm::vec4> x(words()), y(words()); // beside the samples the middle, to which nothing is counted
        const std::vector<glm::dvec3> points = lightPoints(light, pattern_, count_, frame.seed);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec4 at = toLight * glm::dvec4(points[i], 1);
            x[i / 4][static_cast<int>(i % 4)] = static_cast<float>(at.x);
            y[i / 4][static_cast<int>(i % 4)] = static_cast<float>(at.y);
        }
        const std::size_t pixels = static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y);
        counters_.clear(pixels * words() * sizeof(std::uint32_t));
        counters_.bindStorage(1);
        wedge_.set("positions", frame.gbuffer.position())
            .set("unitLightFromWorld", glm::mat4(toLight))
            .set("middle", glm::vec3(light.centre))
            .set("samplesX", x)
            .set("samplesY", y)
            .set("width", frame.size.x);
        wedges_.draw(frame, wedge_, gl::RenderTarget({&frame.gbuffer.depthStencil()}));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }

    [[nodiscard]] std::size_t words() const { return (static_cast<std::size_t>(count_) + 3) / 4; }

    int count_;
    std::string pattern_;
    PenumbraWedges wedges_{Silhouettes::OfLight};
    gl::Program wedge_, resolve_;
    std::optional<gl::Texture> layers_; // that hide the light's middle
    gl::Buffer counters_;
};

Parameter sampleCount() {
    Parameter parameter = lightCountParameter("light samples, a counter of each in every pixel");
    parameter.domain = IntegerRange{1, 256};
    return parameter;
}

} // namespace

Entry depthComplexity() {
    return {.id = "depth-complexity",
            .title = "Depth complexity sampling in penumbra wedges",
            .source = {Document::Dissertation, "2.3.5, Figure 2.24"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutArea,
            .parameters = {sampleCount(), lightPatternParameter()},
            .figures = wedgeFigures(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<DepthComplexity>(p); }};
}

} // namespace shadowbench::techniques
