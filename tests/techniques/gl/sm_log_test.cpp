// Logarithmic perspective shadow maps: as wrong near the eye as far from it, with edges that are curves in the map; no
// better than a focused map where light and camera look at each other.
#include "techniques/gl/counters.h"
#include "techniques/maps/sm-log/log_view.h"
#include "tests/support/ground_score.h"
#include "tests/support/rows_over_frames.h"
#include "tests/support/shader_function.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SmLog, IsRightAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-log"), 3).mismatch, 0);
}

TEST(SmLog, EdgesOfLongTrianglesAreWhereTheyAre) { // chords of their curves would lie metres beside them
    Scene scene = avenueScene(0.5);
    scene.objects.push_back(object(box({0.3, 0.3, 90}), {-1.1, 2.3, -46}));
    EXPECT_LT(mismatchOn(1, scene, "sm-log:map=4096"), 0.001);
}

TEST(SmLog, TrianglesBehindTheCameraTakeNoFragments) {
    const auto fragments = [](int boxes) {
        Scene scene = avenueScene(0.5);
        for (int i = 0; i < boxes; ++i) scene.objects.push_back(object(box({0.3, 0.3, 0.3}), {0.2, 2.3, 30 - 0.1 * i}));
        Stage stage(scene);
        stage.show(0);
        gl::WorkMeter meter;
        rendered(stage, "sm-log:map=256");
        return static_cast<double>(meter.finish().fragments);
    };
    EXPECT_LT(fragments(21), fragments(1) + 256 * 256); // what one triangle takes that covers the map
}

TEST(SmLog, AFlatGroundDoesNotShadowItself) {
    Scene scene = avenueScene(0.5);
    scene.objects.resize(1);
    for (const double elevation : {12.0, 35.0, 80.0}) {
        const double up = glm::radians(elevation);
        scene.light.direction = {std::cos(up), -std::sin(up), 0};
        Stage stage(scene);
        stage.show(0);
        const Image<float> image = rendered(stage, "sm-log");
        const metrics::Drawn drawn = stage.drawn();
        for (std::size_t i = 0; i < image.size(); ++i)
            if (drawn.id[i] == 1) {
                ASSERT_EQ(image[i], 1) << elevation << " " << i;
            }
    }
}

TEST(SmLogShader, PutsPointsWhereTheFitDoesAndBack) {
    const Scene scene = boxScene();
    const techniques::LogView view = techniques::fitLog(scene.light, snapshot(scene, 0), scene.camera, 1);
    std::vector<glm::vec4> points;
    for (float s = 0.05F; s < 1; s += 0.1F)
        for (float t = 0.05F; t < 1; t += 0.1F) {
            const double v = view.near * std::pow(view.far / view.near, t);
            points.emplace_back((view.left + s * (view.right - view.left)) * v, v, 0, 0);
        }
    const auto mapped =
        evaluated("maps/sm-log/log.glsl", "onMap(x.xy), onPlane(onMap(x.xy))", points, {}, [&](gl::Program& program) {
            program.set("slopes", glm::vec2(view.left, view.right - view.left))
                .set("warp", glm::vec2(view.near, std::log(view.far / view.near)));
        });
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 expected = view.onMap(glm::dvec2(points[i]));
        EXPECT_NEAR(mapped[i].x, expected.x, 1e-5);
        EXPECT_NEAR(mapped[i].y, expected.y, 1e-5);
        EXPECT_NEAR(mapped[i].z, points[i].x, 1e-4 * view.far);
        EXPECT_NEAR(mapped[i].w, points[i].y, 1e-4 * view.far);
    }
}

} // namespace
} // namespace shadowbench
