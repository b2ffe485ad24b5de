// Views of an omnidirectional light against closed forms.
#include "techniques/shared/light_views/cube_view.h"

#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

TEST(CubeViews, HoldEveryDirectionOnTheSideThatItLeavesBy) {
    const glm::dvec3 light(0.3, 1.2, -0.7);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(i % 2 == 0 ? -5 : 6, i / 2 % 2 == 0 ? -2 : 7, i / 4 == 0 ? -4 : 3);
    const auto views = cubeViews(light, points);
    ASSERT_EQ(views.size(), 6U);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 d(std::sin(1.7 * i), std::sin(2.9 * i + 1), std::sin(4.3 * i + 2));
        const glm::dvec3 size = glm::abs(d);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t side = 2 * static_cast<std::size_t>(axis) + (d[axis] < 0 ? 1 : 0);
        const glm::dvec4 h = views[side].clipFromWorld * glm::dvec4(light + 2.0 * d / size[axis], 1);
        EXPECT_NEAR(h.w, 2, 1e-9);
        EXPECT_LE(std::max(std::abs(h.x), std::abs(h.y)), h.w * (1 + 1e-9));
        EXPECT_LE(std::abs(h.z), h.w);
        for (std::size_t other = 0; other < 6; ++other) {
            const glm::dvec4 o = views[other].clipFromWorld * glm::dvec4(light + 2.0 * d / size[axis], 1);
            const bool outside = o.w <= 0 || std::max(std::abs(o.x), std::abs(o.y)) >= o.w * (1 - 1e-9);
            EXPECT_EQ(outside, other != side);
        }
    }
}

} // namespace
} // namespace shadowbench::techniques
