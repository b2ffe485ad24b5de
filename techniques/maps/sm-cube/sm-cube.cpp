// Omnidirectional shadow map: six depth maps on the sides of a cube around the light. Course, "Extensions" (omni-directional
// light sources). The six share the texels of one map of `map`² and lie in one texture, which tests as a cube map does.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/maps/depth_atlas.h"

namespace shadowbench::techniques {
namespace {

class CubeMap final : public Technique {
public:
    explicit CubeMap(const Parameters& p)
        : atlas_(squareTiles(p.integer("map"), 6), biasFrom(p)),
          resolve_(gl::Program::screen("maps/sm-cube/sm-cube.frag", {{"TILES", "6"}})) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = frame.snapshot.light.centre;
        atlas_.draw(cubeViews(light_, boundingCorners(frame.snapshot)), frame);
        atlas_.bindTo(resolve_);
        resolve_.set("positions", frame.gbuffer.position()).set("light", glm::vec3(light_));
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        return {atlas_.bare("course, Extensions: a map for each side"),
                bareLookup("resolve", "course, Extensions: one test a pixel", frame.size,
                           {{gl::Format::Depth32F, atlas_.texture().size(), Read::Compare}})};
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
