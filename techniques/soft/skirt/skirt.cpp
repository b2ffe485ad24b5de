// Skirts (de Boer 2006), after Scherzer 2.3.2, Fig. 2.19:
// 1. a depth map from the light's centre;
// 2. an edge filter finds the texels at the outlines of casters; in the skirt buffer they have attenuation 1 and their own
//    depth, all others 0;
// 3. n passes from one buffer to the other let the attenuation fall off around the edges and take the least depth of the
//    neighbours; n is in proportion to the light's radius;
// 4. a lit receiver reads the skirt at its texel, by the depths of occluder, light and receiver as a share of the outer
//    penumbra; one in hard shadow searches for the nearest lit texel, for the inner penumbra.
// No penumbra is wider than the skirt to either side.
//
// `spread=smoothing` is the source's: a pass takes the mean attenuation of a texel and its neighbours, and their least
// depth, each for itself. Edges keep attenuation 1, for which the source has no word: means would soon leave nothing of a
// line of texels. What is left is a bell that goes to 0 over √(πn/3) texels (soft/spread.h): penumbrae are not quite ramps,
// and n would have to grow with the square of the light's radius, where the source has it grow with the radius. Where skirts
// meet, attenuation and depth are those of two edges, so that surfaces darken along their own outlines. `spread=distance`,
// the default, departs from it: a pass takes the greatest attenuation of the neighbours less the way to them, which falls
// linearly to 0 over n texels, and the skirt of the edge nearer to the light covers others. Ways are shares of a rectangle's
// own width and height (the paper's light is a disk).
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/nearest_texel.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "techniques/soft/spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr double radiusOfPasses = 0.1; // of the light, in its distance from the nearest caster: what `passes` are meant for

class Skirt final : public Technique {
public:
    explicit Skirt(const Parameters& p)
        : passes_(p.integer("passes")), smoothed_(isSmoothed(p)), edge_(static_cast<float>(p.real("edge"))),
          followPlane_(p.text("bias") == "slope"),
          map_(p.integer("map"), biasFrom(p)), skirts_{gl::Texture(gl::Format::RG32F, glm::ivec2(map_.side()),
                                                                   gl::Filter::Linear),
                                                       gl::Texture(gl::Format::RG32F, glm::ivec2(map_.side()),
                                                                   gl::Filter::Linear)} {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        edges_.set("linearDepth", map_.texture()).set("leastStep", edge_);
        resolve(frame, {&skirts_[0]}, edges_, "edge filter");
        grow(frame);

        const auto reach = static_cast<float>(spreadReach(count_, smoothed_));
        const float edgeAttenuation = 1 - 0.5F / reach;
        setNearestTexel(resolve_, light, view_, map_.side(), widestSearch, followPlane_);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("linearDepth", map_.texture())
            .set("skirt", skirts_[0])
            .set("edgeAttenuation", edgeAttenuation)
            .set("fallOver", (smoothed_ ? reach / edgeAttenuation : reach) * texel(light)) // a bell goes to 0 in the end
            .set("skirtReach", reach * texel(light))
            .set("depthReach", static_cast<float>(count_) * texel(light));
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"passes", static_cast<double>(count_)}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    /// The finer of the map's two distances between texels.
    [[nodiscard]] float texel(const Light& light) const {
        const glm::vec2 reach(texelReach(light, view_, map_.side()));
        return std::min(reach.x, reach.y);
    }

    void grow(const Frame& frame) {
        const auto pass = frame.pass("skirt");
        const Light& light = frame.snapshot.light;
        const double radius = 0.25 * (glm::length(light.u) + glm::length(light.v));
        const double passes = std::round(passes_ * radius / (radiusOfPasses * view_.near));
        count_ = static_cast<int>(std::clamp(passes, 1.0, static_cast<double>(map_.side())));
        const glm::vec2 way = glm::vec2(texelReach(light, view_, map_.side())) / texel(light);
        if (!smoothed_) spread_.set("leastStep", edge_).set("falloff", way / static_cast<float>(count_));
        for (int i = 0; i < count_; ++i) {
            spread_.set("skirt", skirts_[0]);
            const gl::RenderTarget target({&skirts_[1]});
            target.bind();
            spread_.drawScreen();
            std::swap(skirts_[0], skirts_[1]);
        }
    }

    int passes_, count_ = 0;
    bool smoothed_;
    float edge_;
    bool followPlane_;
    LightView view_;
    LinearDepthMap map_;
    std::array<gl::Texture, 2> skirts_; // attenuation, 1 / depth of its edge
    gl::Program edges_ = gl::Program::screen("soft/skirt/edges.frag");
    gl::Program spread_ = gl::Program::screen(smoothed_ ? "soft/skirt/smooth.frag" : "soft/skirt/grow.frag");
    gl::Program resolve_ = gl::Program::screen("soft/skirt/skirt.frag");
};

} // namespace

Entry skirt() {
    std::vector<Parameter> parameters = depthMapParameters();
    parameters.push_back(
        {"passes", "16", IntegerRange{1, 256},
         "over the skirt buffer, for a light whose radius is a tenth of its distance from the nearest caster; "
         "others in proportion, up to the map's side",
         ""});
    parameters.push_back(spreadParameter("distance", "dissertation, 2.3.2"));
    parameters.push_back(
        {"edge", "0.01", RealRange{1e-5, 1}, "least step of depth at an outline, as a share of the depth behind it", ""});
    return {.id = "skirt",
            .title = "Skirts around the edges of a shadow map",
            .source = {Document::Dissertation, "2.3.2, Fig. 2.19"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutArea,
            .parameters = std::move(parameters),
            .figures = {{"passes", "over the skirt buffer, which limit the penumbra to each side of a hard edge"}},
            .variants = {"", "spread=smoothing"},
            .make = [](const Parameters& p) { return std::make_unique<Skirt>(p); }};
}

} // namespace shadowbench::techniques
