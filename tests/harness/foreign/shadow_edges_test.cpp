// Shifts show in all edges alike; errors of techniques do not.
#include "harness/foreign/shadow_edges.h"
#include "tests/harness/foreign/exact_edges.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

class ShadowEdges : public testing::Test {
protected:
    static Image<float> drawn(double width, const std::function<double(double, double)>& distance) {
        return ExactEdges::drawn(width, distance);
    }
    [[nodiscard]] ShiftEvidence shift(const Image<float>& v) const {
        return shiftEvidence({v, edges_.truth, edges_.mask}, true);
    }

    const ExactEdges edges_;
};

TEST_F(ShadowEdges, OfAShiftedImageAllSayHowFarItIs) {
    for (const double width : {0.01, 3.0})
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, -1), std::pair(-2, 1)}) {
            const ShiftEvidence found =
                shift(drawn(width, [dx = dx, dy = dy](double x, double y) { return distanceAt(x - dx, y - dy); }));
            EXPECT_EQ(found.by, glm::ivec2(dx, dy));
            EXPECT_TRUE(isSure(found)) << found.towardsLight << ' ' << found.towardsShadow << ' ' << found.agreement << ' '
                                       << found.overHalf << ' ' << found.overMore;
        }
}

TEST_F(ShadowEdges, AShiftIsFoundUnderErrorsThatAreFarLargerElsewhere) {
    const ShiftEvidence found = shift(drawn(0.01, [](double x, double y) { // waves of 5 pixels about the large disk
        return distanceAt(x - 1, y) + (y < 60 && x < 70 ? 5 * std::sin(0.4 * x) * std::cos(0.5 * y) : 0);
    }));
    EXPECT_EQ(found.by, glm::ivec2(1, 0));
    EXPECT_TRUE(isSure(found)) << found.towardsLight << ' ' << found.towardsShadow << ' ' << found.agreement << ' '
                               << found.overHalf << ' ' << found.overMore;
}

TEST_F(ShadowEdges, AreNotShiftedWhereTheyAreRightTooLargeOrRagged) {
    const std::function<double(double, double)> honest[] = {
        distanceAt, [](double x, double y) { return distanceAt(x, y) - 1; },                         // all shadows larger
        [](double x, double y) { return distanceAt(8 * std::round(x / 8), 8 * std::round(y / 8)); }, // texels
        [](double x, double y) { return distanceAt(x - 0.02 * y, y); }, // moved in the world: farther where it is near
    };
    for (const double width : {0.01, 3.0})
        for (const auto& distance : honest) {
            const ShiftEvidence e = shift(drawn(width, distance));
            EXPECT_FALSE(isSure(e)) << &distance - honest << ": " << e.by.x << ' ' << e.by.y << ", " << e.towardsLight << ' '
                                    << e.towardsShadow << ' ' << e.agreement << ' ' << e.overHalf << ' ' << e.overMore;
        }
}

} // namespace
} // namespace shadowbench::foreign
