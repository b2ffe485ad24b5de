// Omnidirectional shadow map: six depth maps on the sides of a cube around the light. Course, "Extensions" (omni-directional
// light sources). The six share the texels of one map of `map`² and lie in one texture, which tests as a cube map does. Into
// each side are drawn the casters whose box meets it.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/visible_part.h"
#include "techniques/shared/maps/depth_atlas.h"

namespace shadowbench::techniques {
namespace {

/// Whether the camera sees some of the scene's box through the side: else no pixel is tested against its map.
bool isSeen(const LightView& side, const Frame& frame) {
    const auto frustum = frustumPlanes(side.clipFromWorld);
    std::vector<glm::dvec4> sides(frustum.begin(), frustum.begin() + 4);
    for (glm::dvec4& plane : sides) plane.w += 1e-5 * side.far; // the G-buffer's positions are rounded
    return !visiblePart(frame.snapshot.bounds(), frame.snapshot.camera, frame.aspect(), sides).empty();
}

class CubeMap final : public Technique {
public:
    explicit CubeMap(const Parameters& p)
        : atlas_(squareTiles(p.integer("map"), 6), biasFrom(p)),
          resolve_(gl::Program::screen("maps/sm-cube/sm-cube.frag", {{"TILES", "6"}})) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = frame.snapshot.light.centre;
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        const std::vector<LightView> sides = cubeViews(light_, corners);
        std::vector<std::vector<bool>> casters;
        for (const LightView& side : sides)
            casters.push_back(isSeen(side, frame) ? castersIn(side, corners) : std::vector<bool>(corners.size() / 8, false));
        atlas_.draw(sides, frame, casters);
        atlas_.bindTo(resolve_);
        resolve_.set("positions", frame.gbuffer.position()).set("light", glm::vec3(light_));
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return atlas_.pointAt(cubeSide(world - light_), world);
    }

private:
    glm::dvec3 light_{0};
    DepthAtlas atlas_;
    gl::Program resolve_;
};

} // namespace

Entry smCube() {
    return {.id = "sm-cube",
            .title = "Cube shadow map",
            .source = {Document::Course, "Extensions"},
            .answer = Answer::Hard,
            .notApplicable = lightWithoutPosition,
            .parameters = depthMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<CubeMap>(p); }};
}

} // namespace shadowbench::techniques
