// Cascades with stable texels: edges that stay where they are while the camera moves, and what that costs in texels.
#include "tests/support/ground_score.h"
#include "tests/support/rows_over_frames.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace shadowbench {
namespace {

/// A grid of points on the ground by what the row shows of them, −1 where the camera sees something else.
std::vector<float> onGround(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    stage.show(0);
    const Image<float> image = rendered(stage, variant);
    const metrics::Drawn drawn = stage.drawn();
    std::vector<float> shown;
    for (double x = -1; x <= 2; x += 0.02)
        for (double z = -9; z <= -3; z += 0.02) {
            const glm::dvec3 at = scene.camera.project({x, 0, z}, scene.size);
            const int px = static_cast<int>(std::floor(at.x)), py = static_cast<int>(std::floor(at.y));
            const bool seen = px >= 0 && py >= 0 && px < scene.size.x && py < scene.size.y && drawn.id(px, py) == 1;
            shown.push_back(seen ? image(px, py) : -1);
        }
    return shown;
}

/// How much visibility changes in all, between poses of a camera that moves on and turns, of which pixels are much smaller
/// than texels.
double changes(const std::string& variant) {
    Scene scene = avenueScene(0.5);
    scene.size = {768, 768};
    std::vector<float> before;
    double sum = 0;
    for (const double moved : {0.0, 0.037, 0.081, 0.123}) {
        scene.camera.eye = {moved, 1.7, -0.4 * moved};
        scene.camera.target = {2.3 * moved, 1.1, -10};
        const std::vector<float> now = onGround(scene, variant);
        for (std::size_t i = 0; i < before.size(); ++i)
            if (now[i] >= 0 && before[i] >= 0) sum += std::abs(now[i] - before[i]);
        before = now;
    }
    return sum;
}

TEST(SmStable, EdgesStayWhereTheyAreWhileTheCameraMovesAndTurns) {
    const double crawling = changes("sm-cascaded:map=256,fit=view,lambda=0.5");
    EXPECT_GT(crawling, 500);
    EXPECT_LT(changes("sm-cascaded:map=256,fit=view,lambda=0.5,stable=texels"), 0.5 * crawling); // the maps alone
    EXPECT_LT(changes("sm-stable:map=256"), 0.5 * changes("sm-stable:map=256,stable=none"));     // under the filter
}

TEST(SmStable, LosesTexelsToTheBallAroundASlice) {
    const Scene scene = avenueScene(0.5);
    const double tight = mismatchOn(1, scene, "sm-cascaded:map=512,fit=view,lambda=0.5");
    EXPECT_GT(tight, 0.001);
    EXPECT_GT(mismatchOn(1, scene, "sm-cascaded:map=512,fit=view,lambda=0.5,stable=texels"), 1.3 * tight);
}

TEST(SmStable, FourComparisonsAreARampOfTwoTexels) { // their weights over three texels sum to one wherever the receiver lies
    Scene scene = groundScene(256);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0, 2.2, 6}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 40}; // looks under the plate
    scene.objects.push_back(object(box({20, 0.1, 40}), {10.013, 3, 0}));
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf("sm-stable:slices=1,map=64");
    const Image<float> image = imageAfter(stage, *row, 1);
    std::set<float> values;
    const int y = 128;
    for (int x = 1; x < 256; ++x) {
        EXPECT_LE(image(x, y), image(x - 1, y) + 1e-6F) << x; // from lit to shadowed, without steps back
        values.insert(image(x, y));
    }
    const metrics::Drawn drawn = stage.drawn();
    double from = 1e9, to = -1e9;
    for (int x = 0; x < 256; ++x)
        if (image(x, y) > 0 && image(x, y) < 1) {
            const double at = row->mapPoint(glm::dvec3(drawn.position(x, y))).value().x;
            from = std::min(from, at);
            to = std::max(to, at);
        }
    EXPECT_NEAR(to - from, 2, 0.1);
    EXPECT_GT(values.size(), 8U);
}

TEST(SmStable, AFlatGroundDoesNotShadowItself) {
    for (const double elevation : {12.0, 35.0, 80.0}) {
        Scene scene = avenueScene(0.5);
        scene.objects.resize(1);
        const double up = glm::radians(elevation);
        scene.light.direction = {std::cos(up), -std::sin(up), 0};
        Stage stage(scene);
        stage.show(0);
        const Image<float> image = imageAfter(stage, "sm-stable", 1);
        const metrics::Drawn drawn = stage.drawn();
        for (std::size_t i = 0; i < image.size(); ++i)
            if (drawn.id[i] == 1) {
                ASSERT_EQ(image[i], 1) << elevation << " " << i;
            }
    }
}

} // namespace
} // namespace shadowbench
