// Dual-paraboloid shadow map (Brabec, Annen, Seidel 2002): two maps, each of a half space around the light, in two passes.
// Course, "Extensions" (omni-directional light sources). The mapping is made at vertices, so that casters must be finely
// tessellated: edges of large triangles stay straight in the map and bend in space. The two share the texels of one map of
// `map`². Departure: depth is the distance from the light over the farthest one, linear; each map shows a little more than
// its half space, for texels on the rim; into each are drawn the casters whose box it shows some of.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/maps/sm-dual-paraboloid/paraboloid.h"
#include "techniques/shared/maps/depth_atlas.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <vector>

namespace shadowbench::techniques {
namespace {

gl::Defines paraboloidDefines() { return {{"FILLED", fmt::format("{}", paraboloidFilled)}}; }

gl::Defines drawDefines() {
    gl::Defines defines = paraboloidDefines();
    defines.emplace_back("RIM", fmt::format("{}", paraboloidRim));
    return defines;
}

/// For each placement, in the order of `corners` (`boundingCorners`), whether the map of the half space shows some of its
/// box.
std::vector<bool> castersOf(const glm::dmat4& halfSpace, const std::vector<glm::dvec3>& corners) {
    std::vector<bool> casters;
    for (std::size_t i = 0; i + 8 <= corners.size(); i += 8)
        casters.push_back(!std::ranges::all_of(std::span(corners).subspan(i, 8), [&](const glm::dvec3& p) {
            return beyondRim(glm::dvec3(halfSpace * glm::dvec4(p, 1)));
        }));
    return casters;
}

class DualParaboloid final : public Technique {
public:
    explicit DualParaboloid(const Parameters& p)
        : bias_(biasFrom(p)), atlas_(squareTiles(p.integer("map"), 2), bias_),
          draw_("maps/sm-dual-paraboloid/paraboloid.vert", "gl/depth_only.frag", drawDefines()),
          resolve_(gl::Program::screen("maps/sm-dual-paraboloid/sm-dual-paraboloid.frag", paraboloidDefines())) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const glm::dvec3 light = frame.snapshot.light.centre;
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        double farthest = 0;
        for (const glm::dvec3& p : corners) farthest = std::max(farthest, glm::distance(p, light));
        const auto far = static_cast<float>(farthest * (1 + 1e-6));
        views_ = halfSpaces(light, frame.snapshot.bounds().centre());

        draw_.set("far", far).set("constantBias", static_cast<float>(bias_.units * depthStep));
        atlas_.drawTiles(frame, [&](std::size_t i) {
            const CasterState state(bias_);
            glEnable(GL_CLIP_DISTANCE0);
            draw_.set("lightFromWorld", glm::mat4(views_[i])).use();
            frame.scene.draw(castersOf(views_[i], corners));
            glDisable(GL_CLIP_DISTANCE0);
        });
        resolve_.set("positions", frame.gbuffer.position())
            .set("depthAtlas", atlas_.texture())
            .set("lightFromWorld", glm::mat4(views_[0]))
            .set("far", far);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        const glm::dvec3 front(views_[0] * glm::dvec4(world, 1));
        const bool back = front.z < 0; // as in sm-dual-paraboloid.frag
        const glm::dvec2 at(paraboloid(back ? front * glm::dvec3(-1, 1, -1) : front, 1));
        const Tile& tile = atlas_.tiles()[back ? 1 : 0];
        return glm::dvec2(tile.at) + (0.5 + 0.5 * at) * glm::dvec2(tile.size);
    }

private:
    /// Frames at the light with z towards the middle of the scene, and away from it.
    static std::array<glm::dmat4, 2> halfSpaces(const glm::dvec3& light, const glm::dvec3& middle) {
        const glm::dvec3 offset = middle - light;
        const glm::dvec3 axis = glm::length(offset) > 0 ? glm::normalize(offset) : glm::dvec3(0, -1, 0);
        const glm::dvec3 up = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
        const glm::dmat4 turned = glm::rotate(glm::dmat4(1), glm::pi<double>(), glm::dvec3(0, 1, 0));
        const glm::dmat4 back = glm::lookAt(light, light + axis, up); // z runs against the view direction
        return {turned * back, back};
    }

    Bias bias_;
    std::array<glm::dmat4, 2> views_{}; // of the frame last rendered
    DepthAtlas atlas_;
    gl::Program draw_, resolve_;
};

} // namespace

Entry smDualParaboloid() {
    return {.id = "sm-dual-paraboloid",
            .title = "Dual-paraboloid shadow map",
            .source = {Document::Course, "Extensions"},
            .answer = Answer::Hard,
            .notApplicable = lightWithoutPosition,
            .parameters = depthMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<DualParaboloid>(p); }};
}

} // namespace shadowbench::techniques
