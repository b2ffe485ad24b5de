#include "base/error.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::testing {

using namespace hard;
namespace {

constexpr glm::ivec2 size(64, 48);

PrimaryHits hitsOf(SceneBuilder& scene, int threads = 2) { return ExactScene(scene.get(), threads).primaryHits(size); }

TEST(ExactPrimary, GroundIsHitWhereTheRayMeetsItsPlane) {
    SceneBuilder scene;
    scene.add(plane(50)).pointLight({1, 5, 1}).camera({1, 4, 7}, {0, 0, 0});
    const PrimaryHits hits = hitsOf(scene);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            ASSERT_EQ(hits.id(x, y), 1U);
            ASSERT_EQ(hits.surface(x, y), Surface::Receiver);
            const glm::dvec3 expected = groundPoint(scene.get().camera, x, y, size);
            ASSERT_LT(glm::distance(glm::dvec3(hits.position(x, y)), expected), 1e-5); // float rounding of metres up to 50
        }
}

TEST(ExactPrimary, NothingIsBackground) {
    SceneBuilder scene;
    scene.pointLight({0, 5, 0}).camera({0, 1, 5}, {0, 0, 0});
    const PrimaryHits hits = hitsOf(scene);
    for (const Surface surface : hits.surface) EXPECT_EQ(surface, Surface::Background);
}

TEST(ExactPrimary, SurfacesOutsideNearAndFarAreNotSeen) {
    SceneBuilder scene; // plates 1 m, 2 m and 4 m below the eye
    scene.add(plate(-9, 9, 4, -9, 9)).add(plate(-9, 9, 3, -9, 9)).add(plate(-9, 9, 1, -9, 9));
    scene.pointLight({0, 9, 0}).cameraAbove(5);
    const auto centre = [&](double near, double far) {
        scene.get().camera.near = near;
        scene.get().camera.far = far;
        return hitsOf(scene).id(size.x / 2, size.y / 2);
    };
    EXPECT_EQ(centre(0.5, 10), 1U);
    EXPECT_EQ(centre(1, 10), 1U); // depth is exactly 1: near belongs to the view
    EXPECT_EQ(centre(std::nextafter(1.0, 2.0), 10), 2U);
    EXPECT_EQ(centre(2.5, 10), 3U);
    EXPECT_EQ(centre(2.5, 4), 3U); // and so does far
    EXPECT_EQ(centre(2.5, std::nextafter(4.0, 0.0)), 0U);
}

TEST(ExactPrimary, EqualDepthGoesToTheLowerSurface) {
    SceneBuilder scene;
    scene.add(plate(-9, 9, 1, -9, 9), {at(0, 0, 0), at(0, 0, 0), at(0.25, 0, 0)});
    scene.pointLight({0, 9, 0}).cameraAbove(5);
    const PrimaryHits hits = hitsOf(scene);
    for (const std::uint32_t id : hits.id) EXPECT_EQ(id, 1U);
}

TEST(ExactPrimary, SurfaceFacesAwayUnlessEyeAndLightAreStrictlyOnOneSide) {
    SceneBuilder scene;
    scene.add(plate(-9, 9, 0, -9, 9)).cameraAbove(5);
    const auto surface = [&] { return hitsOf(scene).surface(10, 10); };
    scene.pointLight({0, 1e-300, 0});
    EXPECT_EQ(surface(), Surface::Receiver);
    scene.pointLight({0, 0, 0});
    EXPECT_EQ(surface(), Surface::FacesAway);
    scene.pointLight({0, -1, 0});
    EXPECT_EQ(surface(), Surface::FacesAway);
    scene.directionalLight({1, 0, 0});
    EXPECT_EQ(surface(), Surface::FacesAway);
    scene.directionalLight(glm::normalize(glm::dvec3(1, -1e-9, 0)));
    EXPECT_EQ(surface(), Surface::Receiver);
    scene.directionalLight(glm::normalize(glm::dvec3(1, 1e-9, 0)));
    EXPECT_EQ(surface(), Surface::FacesAway);
}

TEST(ExactPrimary, AnAreaLightMustLieWhollyOnTheEyesSide) {
    SceneBuilder scene;
    scene.add(plate(-9, 9, 0, -9, 9)).cameraAbove(5);
    const auto surface = [&](LightKind kind, double height) {
        scene.get().light = {kind, {0, height, 0}, {0, -1, 0}, {1, 1, 0}, {0, 0.5, 1}}; // u reaches 0.5 down, v 0.25
        return hitsOf(scene).surface(10, 10);
    };
    EXPECT_EQ(surface(LightKind::Rectangle, 0.76), Surface::Receiver);
    EXPECT_EQ(surface(LightKind::Rectangle, 0.75), Surface::FacesAway); // one corner touches the plane
    EXPECT_EQ(surface(LightKind::Line, 0.51), Surface::Receiver);
    EXPECT_EQ(surface(LightKind::Line, 0.5), Surface::FacesAway);
}

TEST(ExactPrimary, PlacementsTurnScaleAndShiftAlike) {
    // The same box once by its placement and once with its vertices moved beforehand.
    glm::dmat4 place = glm::rotate(at(0.3, 1.1, -0.2), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    place = glm::scale(place, glm::dvec3(1.5, 0.4, 2.0));
    const Mesh cube = box({1, 1, 1});
    Mesh moved = cube;
    for (glm::vec3& p : moved.positions) p = glm::vec3(place * glm::dvec4(p, 1));

    SceneBuilder placed, baked;
    for (SceneBuilder* scene : {&placed, &baked}) scene->add(plane(20)).pointLight({1, 6, 2}).camera({2, 3, 5}, {0, 1, 0});
    placed.add(cube, {place});
    baked.add(moved);
    const PrimaryHits a = hitsOf(placed), b = hitsOf(baked);
    std::size_t differing = 0, onBox = 0;
    for (std::size_t i = 0; i < a.id.size(); ++i) {
        differing += a.id[i] != b.id[i] || a.triangle[i] != b.triangle[i] || a.surface[i] != b.surface[i];
        onBox += a.id[i] == 2;
    }
    EXPECT_EQ(differing, 0U); // float rounding of the baked vertices moves edges by 1e-5 px: no centre is that near here
    EXPECT_GT(onBox, 100U);
}

TEST(ExactPrimary, AFlattenedPlacementIsRefused) {
    SceneBuilder scene;
    scene.add(box({1, 1, 1}), {glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1))})
        .pointLight({1, 6, 2})
        .camera({2, 3, 5}, {0, 1, 0});
    EXPECT_THROW(hitsOf(scene), BadInput);
}

TEST(ExactPrimary, ProgressReachesTheEndOrStopsTheWork) {
    SceneBuilder scene;
    scene.add(plane(20)).pointLight({1, 5, 1}).camera({1, 4, 7}, {0, 0, 0});
    const ExactScene exact(scene.get(), 1);
    double last = 0;
    (void)exact.primaryHits(size, [&](double done, std::string_view) {
        EXPECT_GE(done, last);
        last = done;
    });
    EXPECT_DOUBLE_EQ(last, 1);
    EXPECT_THROW((void)exact.primaryHits(size, [](double, std::string_view) { throw Inconclusive("stop"); }), Inconclusive);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
