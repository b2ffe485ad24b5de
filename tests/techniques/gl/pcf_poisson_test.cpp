// Poisson-disk PCF: the mean of its noise is the disk's own ramp, and turning the disk trades bands for noise.
#include "tests/support/filtered_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr double radius = 6; // texels: wide against the texel that the edge itself is quantised to

std::string variant(int taps, const std::string& rotate) {
    return "pcf-poisson:map=256,radius=6,taps=" + std::to_string(taps) + ",rotate=" + rotate;
}

/// Root of the mean squared difference from the ramp of a full disk, and its mean, over the penumbra.
struct Deviation {
    double rms = 0, mean = 0;
};

Deviation fromFullDisk(const Scene& scene, Stage& stage, const std::vector<GroundPoint>& points) {
    const double reach = radius * texelOf(scene, 256);
    const double edge = mapEdge(stage, 256);
    double squares = 0, sum = 0, count = 0;
    for (const GroundPoint& point : points) {
        const double t = (edge - point.at.x) / reach; // taps at smaller x than the edge are lit
        if (std::abs(t) >= 1) continue;
        const double difference = point.visibility - diskShare(t);
        squares += difference * difference;
        sum += difference;
        ++count;
    }
    return {std::sqrt(squares / count), sum / count};
}

TEST(PcfPoisson, MeanOfTheNoiseIsTheDisksRamp) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const Deviation few = fromFullDisk(scene, stage, groundPoints(stage, rendered(stage, variant(8, "pixel"))));
    const Deviation many = fromFullDisk(scene, stage, groundPoints(stage, rendered(stage, variant(64, "pixel"))));
    EXPECT_NEAR(few.mean, 0, 0.02);
    EXPECT_NEAR(many.mean, 0, 0.02);
    EXPECT_LT(few.rms, 0.5 / std::sqrt(8)); // what 8 independent taps of an even chance would have at most
    EXPECT_LT(many.rms, 0.6 * few.rms);     // texels, which the ramp knows nothing of, leave some
}

TEST(PcfPoisson, TurningTheDiskTradesBandsForNoise) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    // Pixels of one column see almost the same x: bands repeat down a column, noise does not.
    const auto columns = [&](const std::string& rotate) {
        const Image<float> v = rendered(stage, variant(8, rotate));
        double within = 0;
        int count = 0;
        for (int x = 0; x < v.width(); ++x) {
            for (int y = 150; y + 1 < v.height(); ++y) {
                if (v(x, y) <= 0 || v(x, y) >= 1) continue;
                within += std::abs(static_cast<double>(v(x, y)) - static_cast<double>(v(x, y + 1)));
                ++count;
            }
        }
        return within / count;
    };
    EXPECT_GT(columns("pixel"), 0.25 / 8); // neighbours differ by one of 8 taps, at every fourth pixel at least
    EXPECT_LT(columns("none"), 0.2 * columns("pixel"));
}

TEST(PcfPoisson, ASeedIsAnImage) {
    const Scene scene = edgeScene(2, 96);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "pcf-poisson", 1, 3), rendered(stage, "pcf-poisson", 1, 3));
    EXPECT_NE(rendered(stage, "pcf-poisson:map=256", 1, 3), rendered(stage, "pcf-poisson:map=256", 1, 4));
    EXPECT_EQ(rendered(stage, "pcf-poisson:map=256,rotate=none", 1, 3),
              rendered(stage, "pcf-poisson:map=256,rotate=none", 1, 4));
}

} // namespace
} // namespace shadowbench
