// Rays to random points of a light: their tree holds all triangles, the share is unbiased, and its variance is V (1 − V) /
// n.
#include "techniques/modern/triangle_tree.h"
#include "tests/support/rows_over_frames.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

std::unique_ptr<techniques::Technique> rays(int count) {
    const techniques::Variant variant = techniques::parseVariant("ray-traced:rays=" + std::to_string(count));
    return variant.entry->make(variant.parameters);
}

TEST(TriangleTree, EveryTriangleIsALeafWithinAllBoxesAboveIt) {
    Scene scene = boxScene();
    scene.objects.push_back(object(sphere(0.7, 500), {1, 2, 1}));
    const techniques::TriangleTree tree = techniques::treeOver(snapshot(scene, 0));
    std::set<std::uint32_t> leaves;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const techniques::TreeNode& node = tree.nodes[i];
        ASSERT_GT(node.after, i);
        ASSERT_LE(node.after, tree.nodes.size());
        EXPECT_EQ(node.triangle != 0, node.after == i + 1);
        const bool once = node.triangle == 0 || leaves.insert(node.triangle).second;
        EXPECT_TRUE(once);
        for (std::uint32_t below = i; below < node.after; ++below)
            for (std::uint32_t corner = 0; tree.nodes[below].triangle != 0 && corner < 3; ++corner) {
                const glm::vec3 at = tree.corners[3 * (tree.nodes[below].triangle - 1) + corner];
                EXPECT_EQ(glm::clamp(at, node.low, node.high), at);
            }
    }
    EXPECT_EQ(leaves.size(), snapshot(scene, 0).triangles());
    EXPECT_EQ(3 * leaves.size(), tree.corners.size());
}

TEST(RayTraced, FramesAverageToTheExactShare) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto row = rays(16);
    const auto points = slabPoints(stage, meanOver(stage, *row, 16));
    double sum = 0, count = 0;
    for (const SlabPoint& point : points) {
        if (point.truth <= 0 || point.truth >= 1) {
            EXPECT_NEAR(point.visibility, point.truth, 1e-6);
            continue;
        }
        sum += point.visibility - point.truth;
        ++count;
    }
    EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(1.0 / 6 / 256 / count)); // the mean of V (1 − V) over a ramp is 1/6
    EXPECT_NEAR(penumbraRmsError(points), std::sqrt(1.0 / 6 / 256), 0.002);
}

TEST(RayTraced, ASmallLightsShadowIsTheExactOne) { // of a body whose triangles fill no box of the tree
    Scene scene = groundScene();
    scene.objects.push_back(object(box({1.6, 0.4, 1.2}), {0.13, 1.2, 0.21}, 31));
    Stage exact(scene);
    exact.show(0);
    const Image<float> labels = rendered(exact, "sm-alias-free");
    scene.light = {LightKind::Rectangle, scene.light.centre, {0, -1, 0}, {1e-5, 0, 0}, {0, 0, 1e-5}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> image = imageAfter(stage, "ray-traced", 1);
    const metrics::Drawn drawn = stage.drawn();
    int wrong = 0, shadowed = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (drawn.id[i] != 1 || drawn.position[i].y < -0.001) continue;
        shadowed += labels[i] < 0.5F ? 1 : 0;
        wrong += image[i] == labels[i] ? 0 : 1;
    }
    EXPECT_GT(shadowed, 300);
    EXPECT_LE(wrong, 2); // where rounding decides
}

TEST(RayTraced, TheErrorFallsAsTheRootOfTheRays) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    for (const int n : {1, 2, 4}) {
        const auto row = rays(n);
        const double error = penumbraRmsError(slabPoints(stage, imageAfter(stage, *row, 1)));
        EXPECT_NEAR(error, std::sqrt(1.0 / 6 / n), 0.02 * error) << n;
    }
}

TEST(RayTraced, ADiskHasNoCorners) {
    Scene scene = halfPlaneScene();
    scene.light.kind = LightKind::Disk;
    Stage stage(scene);
    stage.show(0);
    const auto row = rays(16);
    const auto points = slabPoints(stage, meanOver(stage, *row, 16));
    // A tenth from either end of the penumbra a disk has less than half a square's share.
    EXPECT_NEAR(visibilityAt(points, litUntil + 0.075), 1 - 0.052, 0.01);
    EXPECT_NEAR(visibilityAt(points, umbraFrom - 0.075), 0.052, 0.01);
}

TEST(RayTraced, TheTreeFollowsWhatMoves) {
    Scene scene = halfPlaneScene();
    scene.timeline = {2, 2};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {2, {2, 0, 0}}};
    Stage stage(scene);
    const auto row = rays(4);
    for (int frame = 0; frame < 4; ++frame) {
        stage.show(frame);
        stage.render(*row, frame, 1);
    }
    EXPECT_EQ(visibilityAt(slabPoints(stage, stage.visibility()), umbraFrom + 0.1), 1); // there was umbra
}

} // namespace
} // namespace shadowbench
