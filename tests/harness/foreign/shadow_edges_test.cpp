// Shifts and encodings show in all edges alike; errors of techniques do not.
#include "harness/foreign/foreign_image.h"
#include "harness/foreign/shadow_edges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

constexpr int side = 128;
constexpr double sure = 3; // e³ times as likely

/// Distance to the edge of two disks and a bar, in pixels, negative in their shadows.
double distanceAt(double x, double y) {
    const double disk = std::hypot(x - 40, y - 30) - 22, small = std::hypot(x - 98, y - 84) - 13;
    const double bar = std::max(std::abs(x - 30) - 7, std::abs(y - 95) - 19);
    return std::min({disk, small, bar});
}

class ShadowEdges : public testing::Test {
protected:
    ShadowEdges() {
        truth_.visibility = Image<float>(side, side);
        truth_.edgeDistance = Image<float>(side, side);
        truth_.surface = Image<groundtruth::Surface>(side, side, groundtruth::Surface::Receiver);
        truth_.id = Image<std::uint32_t>(side, side, 1);
        mask_.scored = Image<std::uint8_t>(side, side, 1);
        mask_.count = side * side;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double distance = distanceAt(x + 0.5, y + 0.5);
                truth_.visibility(x, y) = distance > 0 ? 1 : 0;
                truth_.edgeDistance(x, y) = static_cast<float>(std::abs(distance));
            }
    }

    /// Lit where `distance` of a pixel's centre is above 0, over a ramp of `width` pixels.
    static Image<float> drawn(double width, const std::function<double(double, double)>& distance) {
        Image<float> image(side, side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                image(x, y) = static_cast<float>(std::clamp(0.5 + distance(x + 0.5, y + 0.5) / width, 0.0, 1.0));
        return image;
    }
    [[nodiscard]] ShiftEvidence shift(const Image<float>& v) const { return shiftEvidence({v, truth_, mask_}, true); }
    [[nodiscard]] double straighter(const Image<float>& v, float (*undo)(float)) const {
        return encodingEvidence({v, truth_, mask_}, undo).straighter;
    }
    static Image<float> changed(Image<float> v, float (*by)(float)) {
        std::ranges::transform(v, v.begin(), by);
        return v;
    }

    groundtruth::Reference truth_;
    metrics::Mask mask_;
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

TEST_F(ShadowEdges, GetStraighterWhereAnEncodingIsUndone) {
    for (const double width : {1.5, 5.0})
        for (const double wrong : {0.0, 1.0}) { // where the edge lies does not matter
            const Image<float> v = drawn(width, [wrong](double x, double y) { return distanceAt(x, y) + wrong; });
            EXPECT_LT(straighter(v, linearFromSrgb), -sure);
            EXPECT_LT(straighter(v, srgbFromLinear), -sure);
            EXPECT_GT(straighter(changed(v, srgbFromLinear), linearFromSrgb), sure);
            EXPECT_GT(straighter(changed(v, linearFromSrgb), srgbFromLinear), sure);
        }
    EXPECT_EQ(straighter(truth_.visibility, linearFromSrgb), 0) << "no grey pixel";
}

} // namespace
} // namespace shadowbench::foreign
