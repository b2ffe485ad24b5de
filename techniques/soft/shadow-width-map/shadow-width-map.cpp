// Shadow width maps (Kirsch and Döllner 2003), after Scherzer 2.3.1, Fig. 2.15 and 2.16:
// 1. a depth map from the light's centre;
// 2. a binary map of the occluders, which pass after pass makes a shadow width map: how far inside its occluder's outline a
//    texel lies;
// 3. a receiver in hard shadow reads the width at its texel and divides it by the reach of the inner penumbra there.
// Only the inner penumbra is made: shadows are smaller than they should be.
//
// `spread=smoothing` is the source's: a pass takes the mean of a box of texels, and what is no occluder stays lit. After n
// passes the width is that of a ramp near the outline and goes no farther than √(πn/3) texels (soft/spread.h), to which
// penumbrae are limited. n is as great as the widest penumbra has texels, of which the source says nothing.
// `spread=distance` departs from it: a pass takes the smallest of the box, so that the width is the distance itself. Other
// departures: the paper's blockers and receivers are told apart by hand, here by their bounding boxes
// (shared/casters/blockers.h); the box follows the light's sides, so that umbra begins where the light's own shape fits into
// the occluder.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/shared/casters/blockers.h"
#include "techniques/shared/filters/nearest_texel.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "techniques/soft/shadow-width-map/width_passes.h"
#include "techniques/soft/spread.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace shadowbench::techniques {
namespace {

class ShadowWidthMap final : public Technique {
public:
    explicit ShadowWidthMap(const Parameters& p)
        : smoothed_(isSmoothed(p)),
          map_(p.integer("map"), biasFrom(p)), widths_{gl::Texture(gl::Format::R32F, glm::ivec2(map_.side()),
                                                                   gl::Filter::Linear),
                                                       gl::Texture(gl::Format::R32F, glm::ivec2(map_.side()),
                                                                   gl::Filter::Linear)} {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        passes_ = widthPasses(texelReach(light, view_, map_.side()), 1 / view_.near - 1 / view_.far, map_.side());
        drawOccluders(frame);
        spreadWidths(frame);

        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(view_))
            .set("depthFromWorld", glm::vec4(view_.depthFromWorld))
            .set("linearDepth", map_.texture())
            .set("widthMap", widths_[0])
            .set("reachOfWidth", static_cast<float>(reachOfWidth()))
            .set("widest", static_cast<float>(reach()));
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        const std::vector<bool> shown = blockers(frame.snapshot);
        return {{"passes", static_cast<double>(count())},
                {"occluders", static_cast<double>(std::ranges::count(shown, true))}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    static gl::Program spreading(bool smoothed, int x, int y) {
        return gl::Program::screen(smoothed ? "soft/shadow-width-map/smooth.frag" : "soft/shadow-width-map/grow.frag",
                                   {{"STEP_X", std::to_string(x)}, {"STEP_Y", std::to_string(y)}});
    }

    [[nodiscard]] int count() const { return static_cast<int>(passes_.steps.size()); }

    /// Of the passes, in the units of texelReach: no inner penumbra is wider.
    [[nodiscard]] double reach() const { return spreadReach(count(), smoothed_) * passes_.reachPerPass; }

    /// Of a width of 1: a texel where widths are distances. Means go from what an occluder begins with to the reach.
    [[nodiscard]] double reachOfWidth() const { return smoothed_ ? reach() / atFirst : passes_.reachPerPass; }

    /// The width that every occluder's texel has at first: that of one at its outline, half a texel.
    static constexpr double atFirst = 0.5; // soft/shadow-width-map/occluder.frag

    void drawOccluders(const Frame& frame) {
        const auto pass = frame.pass("occluder map");
        const gl::RenderTarget target({&widths_[0]});
        target.clearColour(0, glm::vec4(0));
        target.bind();
        const CasterPass casters(occluders_, view_, Bias{});
        glDisable(GL_DEPTH_TEST);
        frame.scene.draw(blockers(frame.snapshot));
    }

    void spreadWidths(const Frame& frame) {
        const auto pass = frame.pass("shadow width map");
        int done = 0;
        for (const glm::ivec2& step : passes_.steps) {
            gl::Program& spread = spread_.at(static_cast<std::size_t>(step.x + 2 * step.y - 1)); // a step goes somewhere
            spread.set("widths", widths_[0]);
            if (!smoothed_) spread.set("done", done++);
            const gl::RenderTarget target({&widths_[1]});
            target.bind();
            spread.drawScreen();
            std::swap(widths_[0], widths_[1]);
        }
    }

    bool smoothed_;
    LightView view_;
    LinearDepthMap map_;
    WidthPasses passes_;
    std::array<gl::Texture, 2> widths_;
    gl::Program occluders_{"shared/maps/depth_map.vert", "soft/shadow-width-map/occluder.frag"};
    std::array<gl::Program, 3> spread_{spreading(smoothed_, 1, 0), spreading(smoothed_, 0, 1),
                                       spreading(smoothed_, 1, 1)}; // by texels along x and y
    gl::Program resolve_ = gl::Program::screen("soft/shadow-width-map/shadow-width-map.frag");
};

} // namespace

Entry shadowWidthMap() {
    std::vector<Parameter> parameters = depthMapParameters();
    parameters.push_back(spreadParameter("smoothing", "dissertation, 2.3.1"));
    return {.id = "shadow-width-map",
            .title = "Shadow width map",
            .source = {Document::Dissertation, "2.3.1, Fig. 2.15"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutArea,
            .parameters = std::move(parameters),
            .figures = {{"passes", "passes over the width map: texels of the widest inner penumbra"},
                        {"occluders", "placements in the occluder map"}},
            .variants = {"", "spread=distance"},
            .make = [](const Parameters& p) { return std::make_unique<ShadowWidthMap>(p); }};
}

} // namespace shadowbench::techniques
