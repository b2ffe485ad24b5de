// Cascaded shadow maps: where perspective is what spoils a single map, and where it is not.
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "techniques/shared/maps/receiver_bounds.h"
#include "tests/support/ground_score.h"
#include "tests/support/shader_function.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {
namespace {

TEST(SmCascaded, LeavesAQuarterOfTheErrorAtEqualTexelsOverALongDepthRange) {
    const Scene scene = avenueScene(0.5);
    const double focused = mismatchOn(1, scene, "sm-focused:map=512");
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512"), 0.25 * focused);
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512,fit=view"), 0.25 * focused);
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512,fit=view,lambda=0.5"), 0.5 * focused);
}

TEST(SmCascaded, OneSliceIsTheFocusedMap) {
    const Scene scene = boxScene(128);
    Stage stage(scene);
    stage.show(0);
    EXPECT_LE(differing(rendered(stage, "sm-cascaded:slices=1,fit=view"), rendered(stage, "sm-focused")),
              20U); // rounding at edges
}

TEST(SmCascaded, IsRightAwayFromEdgesForAnyNumberOfSlices) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    for (const char* variant :
         {"sm-cascaded:slices=2", "sm-cascaded:slices=3", "sm-cascaded:slices=7", "sm-cascaded:warp=lispsm",
          "sm-cascaded:fit=view", "sm-cascaded:fit=view,stable=texels", "sm-cascaded:slices=7,blend=0.5"})
        EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, variant), 3).mismatch, 0) << variant;
}

/// The slab in the lower left of the picture, and a wall far behind it: between them no slice has a receiver, and most of
/// the frustum none.
Scene cornerScene() {
    Scene scene = boxScene(256);
    scene.camera = {{1.3, 2.9, 8.1}, {4.7, 3.9, -2}, {0, 1, 0}, 60, 0.5, 90};
    scene.light.centre = {2.7, 9.7, 14.3};
    scene.objects.push_back(object(box({6, 9, 0.2}), {2, 4, -60}));
    return scene;
}

TEST(SmCascaded, IsRightWhereWhatIsSeenTakesPartOfTheFrustum) {
    const Scene scene = cornerScene();
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"sm-cascaded", "sm-cascaded:slices=1", "sm-cascaded:slices=8", "sm-cascaded:warp=lispsm",
                                "sm-cascaded:blend=0.5"}) {
        const BoxScore score = scoreOnGround(scene, stage, rendered(stage, variant), 3);
        EXPECT_EQ(score.mismatch, 0) << variant;
    }
}

TEST(SmCascaded, FittedToWhatIsSeenItSpendsNoTexelsBesideIt) {
    // A wall with a gap: of a long ground only what lies before it is seen, and a strip behind.
    Scene scene = avenueScene(0.5);
    scene.objects.push_back(object(box({60, 4, 0.2}), {31, 2, -14}));
    scene.objects.push_back(object(box({60, 4, 0.2}), {-31, 2, -14}));
    EXPECT_LE(mismatchOn(1, scene, "sm-cascaded:map=512"), 0.7 * mismatchOn(1, scene, "sm-cascaded:map=512,fit=view"));
}

TEST(SmCascaded, BlendedSlicesMeetWithoutASeam) {
    const std::vector<glm::vec4> ends{{2.5, 2.25, 0, 0}, {6, 5.5, 0, 0}, {14, 12, 0, 0}};
    constexpr float step = 0.0078125F; // 2^-7: the ends are met
    std::vector<glm::vec4> depths;
    for (float depth = 1; depth <= 15; depth += step) depths.emplace_back(depth, 0, 0, 0);
    // The number of the map that is read, between two where both are.
    const auto maps = evaluated("shared/maps/slice.glsl", "float(sliceOf(x.x)) + nextWeight(sliceOf(x.x), x.x)", depths,
                                {{"TILES", "3"}}, [&](gl::Program& program) { program.set("sliceEnds", ends); });
    for (std::size_t i = 1; i < depths.size(); ++i) {
        EXPECT_GE(maps[i].x, maps[i - 1].x) << depths[i].x;
        EXPECT_LE(maps[i].x - maps[i - 1].x, step / 0.25F + 1e-5F) << depths[i].x; // the shortest band is 0.25 m long
    }
    for (std::size_t i = 0; i < depths.size(); ++i)
        for (const auto& [depth, map] : {std::pair{2.25F, 0.0F}, {2.375F, 0.5F}, {2.5F, 1.0F}, {5.5F, 1.0F}, {6.0F, 2.0F}})
            if (depths[i].x == depth) {
                EXPECT_NEAR(maps[i].x, map, 1e-5) << depth;
            }
    EXPECT_EQ(maps.back().x, 2);
}

TEST(SmCascaded, TheTexelsOfStableMapsStayInPlaceWhileTheCameraMovesAndTurns) {
    Scene scene = avenueScene(0.5);
    const techniques::Variant variant = techniques::parseVariant("sm-cascaded:fit=view,stable=texels");
    const auto technique = variant.entry->make(variant.parameters);
    const glm::dvec3 world(0.3, 0, -9);
    std::vector<glm::dvec2> texels;
    for (const double moved : {0.0, 0.137, 0.391, 0.777}) {
        scene.camera.eye = {moved, 1.7, -0.3 * moved};
        scene.camera.target = {2 * moved, 1.7 - 0.5 * moved, -10};
        Stage stage(scene);
        stage.show(0);
        stage.render(*technique, 0, 1);
        texels.push_back(technique->mapPoint(world).value());
        const glm::dvec2 steps = texels.back() - texels.front();
        EXPECT_NEAR(steps.x, std::round(steps.x), 1e-6) << moved;
        EXPECT_NEAR(steps.y, std::round(steps.y), 1e-6) << moved;
    }
    EXPECT_NE(texels.front(), texels.back()); // and the map has moved
}

TEST(SmCascaded, CastersThatItLeavesOutWouldChangeNoTexel) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    const std::vector<glm::dvec3> corners = techniques::boundingCorners(frame.snapshot);
    for (const auto fit : {techniques::fitFocused, techniques::fitLispsm}) {
        std::vector<techniques::LightView> views;
        std::vector<std::vector<bool>> casters;
        std::ptrdiff_t leftOut = 0;
        for (const double near : {2.0, 6.0, 18.0, 54.0}) {
            Camera slice = scene.camera;
            slice.near = near;
            slice.far = 3 * near;
            views.push_back(fit(frame.hardLight, frame.snapshot, slice, frame.aspect(), {}));
            casters.push_back(techniques::castersIn(views.back(), corners));
            leftOut += std::ranges::count(casters.back(), false);
        }
        EXPECT_GT(leftOut, 10);
        techniques::DepthAtlas all(techniques::squareTiles(512, 4), {1, 64}),
            culled(techniques::squareTiles(512, 4), {1, 64});
        all.draw(views, frame);
        culled.draw(views, frame, casters);
        EXPECT_EQ(
            differing(gl::RenderTarget({&all.texture()}).readDepth(), gl::RenderTarget({&culled.texture()}).readDepth()),
            0U);
    }
}

TEST(ReceiverBounds, AreThoseOfThePointsThatThePixelsShow) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    const glm::dvec4 eyeDepthFromWorld(0, 0, -1, 0); // the camera looks along -z from z = 0
    const glm::dmat4 clipFromWorld = techniques::fitToScene(frame.hardLight, frame.snapshot).clipFromWorld;
    const std::vector<techniques::DepthRange> ranges{{3, 6}, {-2, -1}, {5, 20}}; // the second holds nothing
    techniques::ReceiverBounds receivers(3);
    const auto boxes = receivers.boxes(frame, eyeDepthFromWorld, ranges, clipFromWorld);
    const auto depths = receivers.depths(frame, eyeDepthFromWorld);

    Bounds first, last;
    double near = 1e9, far = 0;
    const metrics::Drawn drawn = stage.drawn();
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        if (drawn.id[i] == 0) continue;
        const glm::dvec3 p(drawn.position[i]);
        near = std::min(near, -p.z);
        far = std::max(far, -p.z);
        const glm::dvec3 at(clipFromWorld * glm::dvec4(p, 1));
        if (-p.z <= 6) first.add(at); // the first and the last range hold what lies beyond them
        if (-p.z >= 5) last.add(at);
    }
    ASSERT_TRUE(depths && boxes.size() == 3 && boxes[0] && boxes[2]);
    EXPECT_FALSE(boxes[1]);
    EXPECT_NEAR(depths->near, near, 1e-6);
    EXPECT_NEAR(depths->far, far, 1e-4);
    for (const auto& [box, expected] : {std::pair(*boxes[0], first), {*boxes[2], last}})
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(box.low[axis], expected.low[axis], 1e-6);
            EXPECT_NEAR(box.high[axis], expected.high[axis], 1e-6);
        }
}

TEST(ReceiverBounds, AreNothingWhereNoPixelShowsAPoint) {
    Scene scene = boxScene(64);
    scene.camera.target = scene.camera.eye + glm::dvec3(0, 1, 1);
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    techniques::ReceiverBounds receivers(1);
    EXPECT_FALSE(receivers.depths(frame, {0, 0, -1, 0}));
    EXPECT_FALSE(receivers.boxes(frame, {0, 0, -1, 0}, {{1, 2}}, glm::dmat4(1))[0]);
    EXPECT_NO_THROW(rendered(stage, "sm-cascaded"));
}

TEST(SmCascaded, LeavesProjectiveAliasing) {
    // A wall that the sun grazes, at one distance from the camera: slices have nothing to share out.
    Scene scene = groundScene(256);
    scene.camera = {{0, 2, 12}, {0, 2, 0}, {0, 1, 0}, 30, 0.5, 40};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.3, -1, -0.06)), {}, {}};
    scene.objects[0] = object(box({12, 8, 0.2}), {0, 2, 0});
    scene.objects.push_back(object(box({4, 0.1, 0.5}), {-0.5, 3.5, 0.6}, 25));
    const double focused = mismatchOn(1, scene, "sm-focused:map=256");
    EXPECT_GT(focused, 0.001);
    EXPECT_GT(mismatchOn(1, scene, "sm-cascaded:map=256"), 0.7 * focused);
}

} // namespace
} // namespace shadowbench
