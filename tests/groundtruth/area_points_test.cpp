// Single points of a light, decided by the edges around what hides it, against shadow rays.
#include "groundtruth/cgal/area/area.h"
#include "groundtruth/cgal/area/area_points.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/hard/samples.h"
#include "groundtruth/povray/povray.h"
#include "tests/support/povray_scene.h"

#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

constexpr int samples = 64;
constexpr glm::ivec2 size{32, 32};

class PointsOf : public testing::TestWithParam<LightKind> {};

TEST_P(PointsOf, ALightAreVisibleWhereShadowRaysReachThem) {
    Snapshot scene = overlappingPlates();
    scene.light.kind = GetParam();
    if (GetParam() == LightKind::Line) scene.light.v = glm::dvec3(0);
    if (GetParam() == LightKind::Disk) scene.light.v = glm::dvec3(-0.1, 0, 1.8); // at a right angle to u
    std::vector<std::vector<glm::dvec2>> sets(2);
    std::vector<glm::dvec3> lights;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 st = povray::lightSample(i, samples);
        sets[i < samples / 4 ? 0 : 1].push_back(st);
        lights.push_back(scene.light.sample(st));
    }
    const area::LightPoints points(GetParam(), sets);
    const PrimaryHits primary = hard::primaryHits(scene, size);
    const hard::SampledVisibility rays = hard::visibleShare(scene, size, primary, lights);
    const area::AreaScene area(scene);
    int partial = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != Surface::Receiver || rays.undecided(x, y) > 0) continue;
            const area::SampledFraction found = area.sampledFraction({x, y}, size, primary, points);
            ASSERT_EQ(found.visible.size(), 2U);
            ASSERT_EQ(found.visible[0] + found.visible[1], std::lround(samples * rays.share(x, y))) << x << " " << y;
            ASSERT_EQ(found.fraction.low, area.fraction({x, y}, size, primary).low);
            partial += rays.share(x, y) > 0 && rays.share(x, y) < 1 ? 1 : 0;
        }
    EXPECT_GT(partial, 50);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PointsOf, testing::Values(LightKind::Rectangle, LightKind::Disk, LightKind::Line),
                         [](const auto& kind) { return std::string(name(kind.param)); });

} // namespace
} // namespace shadowbench::groundtruth
