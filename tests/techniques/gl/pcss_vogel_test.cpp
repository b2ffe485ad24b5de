// Percentage-closer soft shadows over Vogel disks: the penumbra of a parallel occluder is that of similar triangles, over
// the ramp of a disk, and what engines limit is limited.
#include "tests/support/filtered_scenes.h"
#include "tests/support/rows_over_frames.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// halfPlaneScene() with its plate at another height: the middle of the penumbra lies at `middle`, `half` metres wide to
/// each side.
struct Plate {
    double height;

    [[nodiscard]] double middle() const { return 0.1 + 0.2 * 6 / (6 - height); }
    [[nodiscard]] double half() const { return 0.75 * height / (6 - height); }
    [[nodiscard]] Scene scene() const {
        Scene scene = halfPlaneScene();
        scene.objects[1] = object(box({20, 0.002, 40}), {10.3, height + 0.001, 0});
        return scene;
    }
};

/// Worst mean error, over tenths of the penumbra, of the mean over frames against a disk's ramp `half` metres wide to each
/// side.
double fromDiskRamp(const Plate& plate, const std::string& variant, double half) {
    const Scene scene = plate.scene();
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf(variant);
    const Image<float> mean = meanOver(stage, *row, 16);
    std::vector<double> sums(20), counts(20);
    for (const SlabPoint& point : slabPoints(stage, mean)) {
        const double t = (plate.middle() - point.at.x) / half;
        const int bin = static_cast<int>(std::floor(10 * (0.8 * t + 1)));
        if (bin < 0 || bin >= 20) continue;
        sums[bin] += point.visibility - diskShare(t);
        ++counts[bin];
    }
    double worst = 0;
    for (int bin = 0; bin < 20; ++bin)
        if (counts[bin] > 20) worst = std::max(worst, std::abs(sums[bin] / counts[bin]));
    return worst;
}

TEST(PcssVogel, APenumbraIsAsWideAsSimilarTrianglesSay) {
    for (const double height : {1.0, 2.0, 3.0}) {
        const Plate plate{height};
        EXPECT_LT(fromDiskRamp(plate, "pcss-vogel:blockers=32,taps=32", plate.half()), 0.03) << height;
    }
}

TEST(PcssVogel, ThePenumbraIsNoWiderThanItsCap) {
    EXPECT_LT(fromDiskRamp(Plate{2}, "pcss-vogel:blockers=32,taps=32,widest=0.3", 0.15), 0.05);
    EXPECT_LT(fromDiskRamp(Plate{2}, "pcss-vogel:blockers=32,taps=32,widest=0.9", Plate{2}.half()), 0.03); // 0.75 m
}

TEST(PcssVogel, ASearchThatIsNarrowerThanTheLightCutsTheOuterPenumbraOff) {
    const Plate plate{2};
    const Scene scene = plate.scene();
    Stage stage(scene);
    stage.show(0);
    const auto rim = [&](const std::string& variant) { // a tenth of the light is hidden there
        const Image<float> image = meanOver(stage, *rowOf(variant), 16);
        return visibilityAt(slabPoints(stage, image), plate.middle() - 0.65 * plate.half());
    };
    EXPECT_NEAR(rim("pcss-vogel:blockers=32,taps=32"), diskShare(0.65), 0.03);
    EXPECT_EQ(rim("pcss-vogel:blockers=32,taps=32,cone=5"), 1); // the light is 14° wide
}

TEST(PcssVogel, TheFilterIsNoNarrowerThanItsLeast) {
    Scene scene = Plate{2}.scene();
    scene.light.u.x = scene.light.v.z = 0.01;
    Stage stage(scene);
    stage.show(0);
    const auto width = [&](const std::string& variant) {
        return widthBetween(slabPoints(stage, meanOver(stage, *rowOf(variant), 16)), 0.02, 0.98);
    };
    EXPECT_GT(width("pcss-vogel:map=128,narrowest=4"), 2 * width("pcss-vogel:map=128"));
}

TEST(PcssVogel, FewTapsTurnedFrameByFrameAverageToMany) {
    const Scene scene = Plate{2}.scene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> many = meanOver(stage, *rowOf("pcss-vogel:blockers=64,taps=64"), 16);
    const auto row = rowOf("pcss-vogel:blockers=32");
    const double one = rmsDifference(imageAfter(stage, *row, 1), many);
    EXPECT_LT(rmsDifference(meanOver(stage, *row, 16), many), 0.5 * one);
}

TEST(PcssVogel, BlockersThatAreNotTurnedLeaveBands) { // bevy#22272: "ghost" shadows
    const Scene scene = Plate{3}.scene();
    Stage stage(scene);
    stage.show(0);
    const auto edge =
        [&](const std::string& variant) { // how far from a blocker found to none: where the mean first leaves 1
            double first = 1e30;
            for (const SlabPoint& point : slabPoints(stage, meanOver(stage, *rowOf(variant), 16)))
                if (point.visibility < 0.99) first = std::min(first, point.at.x);
            return first;
        };
    // Eight taps of a disk that stands still reach 0.97 of its rim, and not along x.
    EXPECT_GT(edge("pcss-vogel:turned=filter"), edge("pcss-vogel") + 0.02);
}

} // namespace
} // namespace shadowbench
