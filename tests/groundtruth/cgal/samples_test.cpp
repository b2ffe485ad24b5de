// The N-sample oracle against closed forms and the labels of each sample.
#include "groundtruth/cgal/hard/samples.h"

#include "base/error.h"
#include "tests/support/area_scenes.h"

namespace shadowbench::groundtruth::testing {

using namespace hard;
namespace {

/// side × side cell centres of the light, binary fractions where side is a power of two.
std::vector<glm::dvec3> gridOn(const Light& light, int side) {
    std::vector<glm::dvec3> points;
    for (int t = 0; t < side; ++t)
        for (int s = 0; s < side; ++s) points.push_back(light.sample({(s + 0.5) / side, (t + 0.5) / side}));
    return points;
}

/// Of the slab beside the edge x = `edge` of a half-plane at half the light's height, which hides larger x.
double shareUnderHalfPlane(double x, double edge, const std::vector<glm::dvec3>& lights) {
    const auto seen = std::ranges::count_if(lights, [&](const glm::dvec3& light) { return 0.5 * (x + light.x) < edge; });
    return static_cast<double>(seen) / static_cast<double>(lights.size());
}

TEST(SampledVisibility, IsTheShareOfTheSamplesThatAHalfPlaneLeaves) {
    constexpr glm::ivec2 size(48, 48);
    SceneBuilder scene = litGround();
    scene.add(plate(0.27F, 20, 2, -20, 20)).camera({-2, 1.4, 4}, {0.3, 0, 0});
    const PrimaryHits primary = primaryHits(scene.get(), size);
    const std::vector<glm::dvec3> lights = gridOn(scene.get().light, 6);
    const SampledVisibility found = visibleShare(scene.get(), size, primary, lights);
    std::size_t partial = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (primary.id(x, y) != 1) continue;
            const glm::dvec3 p = groundPoint(scene.get().camera, x, y, size);
            const double expected = shareUnderHalfPlane(p.x, 0.27F, lights);
            ASSERT_FLOAT_EQ(found.share(x, y), static_cast<float>(expected)) << x << ", " << y;
            ASSERT_EQ(found.undecided(x, y), 0U);
            partial += expected > 0 && expected < 1;
        }
    EXPECT_GT(partial, 200U);
}

TEST(SampledVisibility, OfOnePointIsTheLabelOfAPointLightThere) {
    constexpr glm::ivec2 size(64, 64);
    std::mt19937 random(5);
    SceneBuilder scene = litGround();
    scene.add(soup(40, {-1.5F, 0.2F, -1.5F}, {1.5F, 2.5F, 1.5F}, random)).camera({3, 4, 5}, {0, 0.5, 0});
    const PrimaryHits primary = primaryHits(scene.get(), size);
    const std::vector<glm::dvec3> lights = gridOn(scene.get().light, 2);
    std::vector<Reference> labels(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Snapshot one = scene.get();
        one.light = {LightKind::Point, lights[i], {0, -1, 0}, {}, {}};
        labelByRays(one, size, primary, labels[i]);
    }
    const SampledVisibility found = visibleShare(scene.get(), size, primary, lights, 3);
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < found.share.size(); ++i) {
        float sum = 0;
        for (const Reference& label : labels) sum += label.visibility[i];
        ASSERT_EQ(found.share[i], sum / 4) << i; // 0 off the receivers, in both
        receivers += primary.surface[i] == Surface::Receiver;
    }
    EXPECT_GT(receivers, 1000U);
    EXPECT_EQ(found.share, visibleShare(scene.get(), size, primary, lights, 1).share);
}

TEST(SampledVisibility, CountsThePointsThatTouchABorder) {
    // The segments from (0, 0, z) to the columns x = ±1/4, ±3/4 of a light of 4 x 4 samples cross half the height at half of
    // that: one column grazes the edge x = 1/8, the next one is hidden.
    SceneBuilder scene = litGround();
    scene.add(plate(0.125F, 20, 2, -20, 20));
    const Snapshot seen = looksDownOn(scene.get(), {0, 0, 0.0625});
    const PrimaryHits primary = primaryHits(seen, {1, 1});
    const std::vector<glm::dvec3> lights = gridOn(seen.light, 4); // x = ±¼, ±¾
    const SampledVisibility found = visibleShare(seen, {1, 1}, primary, lights);
    EXPECT_EQ(found.share[0], 0.75F);
    EXPECT_EQ(found.undecided[0], 4U);
}

TEST(SampledVisibility, OfNoPointsOrAnotherSizeIsRefused) {
    SceneBuilder scene = litGround();
    scene.camera({3, 4, 5}, {0, 0, 0});
    const PrimaryHits primary = primaryHits(scene.get(), {8, 8});
    EXPECT_THROW(visibleShare(scene.get(), {8, 8}, primary, {}), InternalError);
    EXPECT_THROW(visibleShare(scene.get(), {9, 8}, primary, std::vector<glm::dvec3>{{0, 4, 0}}), InternalError);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
