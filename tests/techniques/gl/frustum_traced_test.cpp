// The rasterised irregular z-buffer against closed forms of its lists, and against the one in compute shaders; against the
// closed form of a shadow: alias_free_test.cpp.
#include "tests/support/ground_score.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// The ground alone, which fills the image, seen from `height` right above under a light from there: cells of a grid are
/// squares of the image.
Scene fromAbove(double height) {
    Scene scene = groundScene(256);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0.1, height, 0.2}, {0.1, 0, 0.2}, {0, 0, -1}, 45, 0.1, 40};
    return scene;
}

double longestList(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    stage.show(0);
    return figuresOf(stage, variant).at("longest_list");
}

TEST(FrustumTraced, TheGridChangesNothing) {
    for (const Scene& scene : {boxScene(128), ringScene(), avenueScene(0.5)}) {
        Stage stage(scene);
        stage.show(0);
        const Image<float> v = rendered(stage, "frustum-traced");
        for (const char* variant : {"frustum-traced:grid=7", "frustum-traced:grid=1000"})
            EXPECT_EQ(rendered(stage, variant), v) << variant;
    }
}

TEST(FrustumTraced, ACellMayHaveMorePixelsThanAListHolds) {
    Scene scene = fromAbove(3);
    scene.objects.push_back(object(box({9, 0.01, 9}), {0.1, 4, 0.2})); // behind the eye: all is in shadow
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "frustum-traced:grid=1");
    EXPECT_EQ(std::count(v.begin(), v.end(), 0.0F), 256 * 256);
}

TEST(FrustumTraced, NeedsNoClosedMeshes) {
    Scene scene = groundScene(256);
    Mesh averted = plane(0.7);
    for (glm::uvec3& triangle : averted.triangles) std::swap(triangle.y, triangle.z);
    scene.objects.push_back(object(averted, {0.13, 1.0, 0.21}));
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "frustum-traced"), rendered(stage, "sm-alias-free"));
}

TEST(FrustumTraced, TrianglesTheSizeOfPixelsReachAllPixelsOfTheCellsThatTheyTouch) {
    Scene scene = groundScene(256);
    scene.objects.push_back(object(bumpy(0.8, 0.3, 5000, 3), {0.13, 1.4, 0.21}));
    Stage stage(scene);
    stage.show(0);
    const Image<float> exact = rendered(stage, "sm-alias-free");
    for (const char* variant : {"frustum-traced:grid=64", "frustum-traced", "frustum-traced:grid=1024"})
        EXPECT_LE(differing(rendered(stage, variant), exact), 3U) << variant; // their slacks differ
}

TEST(FrustumTraced, KeepsContactsThatAShareOfTheSceneLoses) {
    Scene scene = groundScene(256);
    scene.objects.push_back(object(plane(0.7), {0.13, 0.05, 0.21}));
    scene.objects.push_back(object(box({100, 100, 100}), {0, -900, 0})); // a large scene, out of sight
    scene.light.centre = {5.5, 1.5, -4.3};
    Stage stage(scene);
    stage.show(0);
    const auto dark = [](const Image<float>& v) { return std::count(v.begin(), v.end(), 0.0F); };
    const auto all = dark(rendered(stage, "frustum-traced"));
    EXPECT_GT(all, 100);
    EXPECT_EQ(dark(rendered(stage, "sm-alias-free:slack=1e-7")), all);
    EXPECT_EQ(dark(rendered(stage, "sm-alias-free:slack=1e-4")), 0);
    EXPECT_EQ(dark(rendered(stage, "frustum-traced:slack=1e-4")), all);
}

TEST(FrustumTraced, AGridOverTheVisiblePointsSharesThemOutEvenly) {
    // Light and camera look the same way: a cell of 64 per side is a square of 256 / 64 · 1 / 0.98 pixels, 4.08, and holds
    // 5² at most.
    const Scene scene = fromAbove(3);
    EXPECT_EQ(longestList(scene, "frustum-traced:grid=1"), 256 * 256);
    EXPECT_GE(longestList(scene, "frustum-traced:grid=64"), 16);
    EXPECT_LE(longestList(scene, "frustum-traced:grid=64"), 25);
    // However little of the scene is seen.
    EXPECT_LE(longestList(fromAbove(0.6), "frustum-traced:grid=64"), 25);
}

TEST(FrustumTraced, ListsAreLongWhereTheLightsViewCrowdsPixels) { // as a map has too few texels there
    EXPECT_LE(longestList(fromAbove(3), "frustum-traced"), 4);
    EXPECT_GT(longestList(avenueScene(0.5), "frustum-traced"), 200); // half of the image is a few of its 60 m
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    const double fine = figuresOf(stage, "frustum-traced:grid=2048").at("tests"),
                 tests = figuresOf(stage, "frustum-traced").at("tests"),
                 coarse = figuresOf(stage, "frustum-traced:grid=16").at("tests");
    EXPECT_LT(fine, tests);
    EXPECT_GT(coarse, 2 * tests);
}

TEST(FrustumTraced, ATriangleSmallerThanACellIsTestedAgainstTheCellsThatItTouches) {
    Scene scene = fromAbove(3);
    const auto tests = [&] {
        Stage stage(scene);
        stage.show(0);
        return figuresOf(stage, "frustum-traced:grid=64").at("tests");
    };
    const double ofGround = tests();
    Mesh needle = plane(1e-3); // a cell is 4 cm
    needle.triangles.resize(1);
    for (glm::vec3& p : needle.positions) p.z *= 0.1F;
    scene.objects.push_back(object(needle, {0.13, 0.1, 0.21}));
    EXPECT_GE(tests() - ofGround, 16); // a cell's list: AGridOverTheVisiblePointsSharesThemOutEvenly
    EXPECT_LE(tests() - ofGround, 4 * 25);
}

TEST(FrustumTraced, FiguresLeaveTheImageAndTheNextOneAsTheyAre) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> untouched = rendered(stage, "frustum-traced");
    const auto figures = figuresOf(stage, "frustum-traced");
    EXPECT_EQ(stage.visibility(), untouched);
    EXPECT_EQ(rendered(stage, "frustum-traced"), untouched);
    EXPECT_EQ(figuresOf(stage, "frustum-traced"), figures);
}

} // namespace
} // namespace shadowbench
