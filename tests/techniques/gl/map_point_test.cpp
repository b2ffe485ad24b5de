// Where a point lies in a map: what shaders test against, and what techniques answer for the texel-to-pixel ratio
// (Technique::mapPoint), are written twice, in GLSL and in C++. Here the two are compared.
#include "techniques/maps/sm-dual-paraboloid/paraboloid.h"
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/maps/depth_map.h"
#include "tests/support/shader_function.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace techniques;

/// Points around the origin, none of them on an axis.
std::vector<glm::vec4> pointsAround(float step, float reach) {
    std::vector<glm::vec4> points;
    for (float x = -reach + 0.013F; x < reach; x += step)
        for (float y = -reach + 0.029F; y < reach; y += step)
            for (float z = -reach + 0.041F; z < reach; z += step) points.emplace_back(x, y, z, 1);
    return points;
}

void compareMapPoints(const LightView& view) {
    constexpr double side = 1024;
    const std::vector<glm::vec4> points = pointsAround(1.9F, 12);
    const auto mapped =
        evaluated("shared/maps/light_space.glsl", "mapPoint(x.xyz).at, mapPoint(x.xyz).behind ? 1.0 : 0.0", points, {},
                  [&](gl::Program& program) { program.set("mapFromWorld", mapFromWorld(view)); });
    std::size_t inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto texel = texelAt(view, glm::dvec3(points[i]), glm::dvec2(side));
        const glm::dvec2 at = side * glm::dvec2(mapped[i]);
        const double beyond =
            std::max(std::abs(at.x - 0.5 * side), std::abs(at.y - 0.5 * side)) - 0.5 * side; // the map's rim
        const bool held = mapped[i].w == 0 && beyond <= 0;
        if (std::abs(beyond) > 0.1) {
            EXPECT_EQ(texel.has_value(), held) << at.x << " " << at.y << " " << mapped[i].w;
        }
        if (!texel || !held) continue;
        ++inside;
        EXPECT_NEAR(texel->x, at.x, 0.05); // matrices of 32-bit floats
        EXPECT_NEAR(texel->y, at.y, 0.05);
    }
    EXPECT_GT(inside, 50U);
}

TEST(MapPoint, IsTheShadersInAUniformMapOfALamp) {
    const Scene scene = boxScene();
    compareMapPoints(fitToScene(scene.light, snapshot(scene, 0)));
}

TEST(MapPoint, IsTheShadersInAFocusedMapOfTheSun) {
    Scene scene = boxScene();
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}};
    compareMapPoints(fitFocused(scene.light, snapshot(scene, 0), scene.camera, 1));
}

TEST(MapPoint, IsTheShadersInAWarpedMap) {
    const Scene scene = boxScene();
    compareMapPoints(fitLispsm(scene.light, snapshot(scene, 0), scene.camera, 1));
}

// Under the sun a plane's receivers are all moved alike: density in the map, which the metric is about, is that of
// texelAt(). The lift is half of what the plane's depth changes by from texel to texel along x plus along y.
TEST(MapPoint, OfANormalOffsetReceiverIsOneShiftForAPlaneAndLiesAboveItByHalfATexelsSlopes) {
    Scene scene = boxScene();
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}};
    const LightView view = fitLispsm(scene.light, snapshot(scene, 0), scene.camera, 1);
    constexpr double side = 1024;
    const auto prepare = [&](gl::Program& program) {
        program.set("mapFromWorld", mapFromWorld(view));
        if (!program.uses("normalOffset")) return;
        program.set("normalOffset", 1.0F).set("mapTexels", glm::vec2(side));
    };
    std::vector<glm::vec4> points;
    for (const glm::vec4& p : pointsAround(0.7F, 1.5F)) points.emplace_back(p.x, 0, p.z, 1);
    const std::string chunk = "shared/maps/normal_offset.glsl", up = "vec3(0, 1, 0)";
    const auto moved = evaluated(chunk, "mapPoint(movedReceiver(x.xyz, " + up + ")).at, 0.0", points, {}, prepare);
    const auto slopes = evaluated(chunk, "receiverPlaneSlope(x.xyz, " + up + ", mapPoint(x.xyz).at), mapPoint(x.xyz).at.xy",
                                  points, {}, prepare);
    const auto depths = evaluated(chunk, "mapPoint(x.xyz).at, 0.0", points, {}, prepare);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto texel = texelAt(view, glm::dvec3(points[i]), glm::dvec2(side));
        ASSERT_TRUE(texel.has_value());
        const glm::dvec2 shift = side * glm::dvec2(moved[i]) - *texel, slope(slopes[i]);
        EXPECT_LT(glm::length(shift), std::sqrt(0.5)); // half a texel's diagonal at most
        const double plane = static_cast<double>(depths[i].z) + glm::dot(slope, shift) / side;
        const double halfTexel = 0.5 * (std::abs(slope.x) + std::abs(slope.y)) / side;
        EXPECT_NEAR(plane - static_cast<double>(moved[i].z), halfTexel, 0.02 * halfTexel); // matrices of 32-bit floats
    }
}

TEST(CubeSide, IsTheShaders) {
    const std::vector<glm::vec4> directions = pointsAround(0.23F, 1);
    const auto sides = evaluated("shared/maps/cube_side.glsl", "float(sideOf(x.xyz))", directions);
    for (std::size_t i = 0; i < directions.size(); ++i)
        EXPECT_EQ(sides[i].x, static_cast<float>(cubeSide(glm::dvec3(directions[i]))));
}

TEST(Paraboloid, IsTheShaders) {
    std::vector<glm::vec4> positions;
    for (const glm::vec4& p : pointsAround(0.31F, 2))
        if (p.z >= 0) positions.push_back(p);
    const auto mapped =
        evaluated("maps/sm-dual-paraboloid/paraboloid.glsl", "paraboloid(x.xyz), 0.0", positions,
                  {{"FILLED", fmt::format("{}", paraboloidFilled)}}, [](gl::Program& program) { program.set("far", 4.0F); });
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 expected = paraboloid(glm::dvec3(positions[i]), 4);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mapped[i][axis], expected[axis], 1e-6);
    }
}

TEST(SliceOf, IsTheShaders) {
    const std::vector<double> splits{1, 2.5, 6, 14};
    std::vector<glm::vec4> depths;
    for (float depth = 0.3F; depth < 20; depth += 0.17F) depths.emplace_back(depth, 0, 0, 0);
    std::vector<glm::vec4> ends;
    for (std::size_t i = 1; i < splits.size(); ++i) ends.emplace_back(splits[i], 0, 0, 0);
    const auto slices = evaluated("shared/maps/slice.glsl", "float(sliceOf(x.x))", depths, {{"TILES", "3"}},
                                  [&](gl::Program& program) { program.set("sliceEnds", ends); });
    for (std::size_t i = 0; i < depths.size(); ++i)
        EXPECT_EQ(slices[i].x, static_cast<float>(sliceOf(splits, depths[i].x))) << depths[i].x;
}

} // namespace
} // namespace shadowbench
