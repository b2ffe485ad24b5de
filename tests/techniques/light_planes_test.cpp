// Image planes of a light, parts of them and their casters, against closed forms.
#include "scene/meshes/primitives.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/maps/tile_choice.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::techniques {
namespace {

glm::dvec3 mapped(const LightView& view, const glm::dvec3& p) {
    const glm::dvec4 h = view.clipFromWorld * glm::dvec4(p, 1);
    return glm::dvec3(h) / h.w;
}

Light sun(const glm::dvec3& direction) { return {LightKind::Directional, {}, glm::normalize(direction), {}, {}}; }
Light lamp(const glm::dvec3& centre) { return {LightKind::Point, centre, {0, -1, 0}, {}, {}}; }

/// Cubes of 1 m, side by side along x from 0 to `count` metres, under `light`.
Snapshot cubes(const Light& light, int count) {
    Snapshot snapshot;
    snapshot.light = light;
    Batch batch{std::make_shared<Mesh>(box({1, 1, 1})), {}, false, {}};
    for (int i = 0; i < count; ++i) {
        const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(i + 0.5, 0, 0));
        batch.placements.push_back({place, place, static_cast<std::uint32_t>(i + 1)});
    }
    snapshot.batches.push_back(std::move(batch));
    return snapshot;
}

TEST(LightPlanes, IsOneForALightThatSeesTheWholeSceneAtOnce) {
    EXPECT_EQ(lightPlanes(sun({0.3, -1, 0.2}), cubes({}, 4)).size(), 1U);
    EXPECT_EQ(lightPlanes(lamp({2, 9, 1}), cubes({}, 4)).size(), 1U);
}

TEST(LightPlanes, AreSixAroundALightWithinTheSceneOrCloseToIt) {
    EXPECT_EQ(lightPlanes(lamp({2, 0.1, 0.2}), cubes({}, 4)).size(), 6U); // inside
    EXPECT_EQ(lightPlanes(lamp({10, 0.8, 0}), cubes({}, 20)).size(), 6U); // above the middle of a long row: 88° off its axis
}

TEST(LightPlanes, PartOfAPlaneIsThatPartOfItsMap) {
    for (const Light& light : {sun({0.3, -1, 0.2}), lamp({2, 9, 1})}) {
        const LightView whole = lightPlanes(light, cubes(light, 4))[0];
        const LightView part = partOf(whole, {0.25, 0.5}, {0.5, 0.75});
        for (const glm::dvec3& p : {glm::dvec3(0.3, 0.1, -0.2), {1.7, -0.4, 0.3}, {3.1, 0.5, 0.1}}) {
            const glm::dvec3 q = mapped(whole, p);
            const glm::dvec2 inPart = (0.5 * (glm::dvec2(q) + 1.0) - glm::dvec2(0.25, 0.5)) / 0.25; // in [0, 1] if inside
            const glm::dvec3 r = mapped(part, p);
            EXPECT_NEAR(0.5 * (r.x + 1), inPart.x, 1e-9);
            EXPECT_NEAR(0.5 * (r.y + 1), inPart.y, 1e-9);
            EXPECT_NEAR(r.z, q.z, 1e-9);
        }
        EXPECT_NEAR(part.span.x, whole.span.x / 4, 1e-9);
    }
}

TEST(LightPlanes, CastersAreTheBoxesThatMeetThePart) {
    const Snapshot scene = cubes(sun({0, -1, 0}), 8);
    const LightView whole = lightPlanes(scene.light, scene)[0];
    const auto low = 0.5 * (mapped(whole, {2.4, 0, 0}) + 1.0), high = 0.5 * (mapped(whole, {4.6, 0, 0}) + 1.0);
    const int axis = std::abs(high.x - low.x) > 1e-6 ? 0 : 1; // the map's axis along the row
    glm::dvec2 from(0), to(1);
    from[axis] = std::min(low[axis], high[axis]);
    to[axis] = std::max(low[axis], high[axis]);
    EXPECT_EQ(castersIn(partOf(whole, from, to), boundingCorners(scene)),
              (std::vector<bool>{false, false, true, true, true, false, false, false})); // cubes 2–3, 3–4 and 4–5 m
    EXPECT_EQ(castersIn(whole, boundingCorners(scene)), std::vector<bool>(8, true));
}

TEST(LightPlanes, CastersBehindALampAreLeftOut) {
    const Snapshot scene = cubes(lamp({4, 0, 0.7}), 8);
    const auto planes = lightPlanes(scene.light, scene);
    ASSERT_EQ(planes.size(), 6U); // 88° off the axis
    const std::vector<bool> alongX = castersIn(planes[0], boundingCorners(scene)),
                            against = castersIn(planes[1], boundingCorners(scene));
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(alongX[i], i >= 4) << i;
        EXPECT_EQ(against[i], i < 4) << i;
    }
}

TEST(TileTable, GivesEveryCellItsTile) {
    const std::vector<PlaneTile> tiles{{0, {1, 0}, {2, 1}, {}}, {1, {3, 2}, {1, 2}, {}}};
    const auto table = tileTable(tiles, 2, 4);
    ASSERT_EQ(table.size(), 32U);
    for (std::uint32_t i = 0; i < 32; ++i) {
        const bool first = i == 1 || i == 2, second = i == 16 + 2 * 4 + 3 || i == 16 + 3 * 4 + 3;
        EXPECT_EQ(table[i], first ? 1U : second ? 2U : 0U) << i;
    }
}

} // namespace
} // namespace shadowbench::techniques
