// Percentage-closer soft shadows over Vogel disks: the penumbra of a parallel occluder is that of similar triangles, over
// the ramp of a disk, and what engines limit is limited; over cascades it is as wide in each, or as many texels wide.
#include "techniques/shared/light_views/cascades.h"
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
double fromDiskRamp(const Plate& plate, const Scene& scene, const std::string& variant, double half) {
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

double fromDiskRamp(const Plate& plate, const std::string& variant, double half) {
    return fromDiskRamp(plate, plate.scene(), variant, half);
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

/// A plate whose edge, x = 0.3, runs away from the camera, 20 m above a slab and 180 m below a disk of 14 m: one penumbra
/// that the camera sees 5 to 60 m away.
struct LongEdge {
    static constexpr double middle = 0.3 * 200 / 180, half = 7 * 20 / 180.0;
    Scene scene = groundScene(192);
    std::vector<double> ends; // of three cascades

    LongEdge() {
        scene.light = {LightKind::Disk, {0, 200, -30}, {0, -1, 0}, {14, 0, 0}, {0, 0, 14}};
        scene.camera = {{0, 3, 6}, {0, 0, -6}, {0, 1, 0}, 40, 4, 60};
        scene.objects[0] = object(box({80, 0.2, 90}), {0, -0.1, -35});
        scene.objects.push_back(object(box({39.7, 0.002, 90}), {20.15, 20.001, -35}));
        const techniques::DepthRange depths = techniques::visibleDepths(snapshot(scene, 0).bounds(), scene.camera, 1);
        ends = techniques::practicalSplits(depths.near, depths.far, 3, 1);
    }

    [[nodiscard]] double depthOf(const glm::dvec3& p) const {
        return glm::dot(p - scene.camera.eye, scene.camera.basis().forward);
    }
};

/// Of a ramp over a disk's share s, the integral of s (1 − s) in half widths.
double integralOfDisk() {
    double sum = 0;
    for (int i = -500; i < 500; ++i) sum += diskShare((i + 0.5) / 500) * (1 - diskShare((i + 0.5) / 500)) / 500;
    return sum;
}

/// Half the width of the long edge's penumbra between two depths, of the mean over frames: that of the disk's ramp over
/// which v (1 − v) has the same integral.
double halfWidth(const LongEdge& edge, const std::vector<SlabPoint>& points, double low, double high) {
    constexpr double bin = 0.25; // metres: more than a pixel where these are largest
    std::vector<double> sums(48), counts(48);
    for (const SlabPoint& point : points) {
        const double depth = edge.depthOf(point.at), x = (point.at.x - edge.middle) / bin + 24;
        if (depth < low || depth > high || x < 0 || x >= 48) continue;
        sums[static_cast<std::size_t>(x)] += point.visibility;
        ++counts[static_cast<std::size_t>(x)];
    }
    double integral = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (counts[i] > 0) integral += bin * (sums[i] / counts[i]) * (1 - sums[i] / counts[i]);
    return integral / integralOfDisk();
}

/// What of the true width the penumbra has before and behind each seam, and how wide a texel is there, in texels of the
/// first cascade.
struct AtSeam {
    double before, behind, texelBefore, texelBehind;
};

std::vector<AtSeam> atSeams(const std::string& variant) {
    const LongEdge edge;
    Stage stage(edge.scene);
    stage.show(0);
    const auto row = rowOf(variant);
    const std::vector<SlabPoint> points = slabPoints(stage, meanOver(stage, *row, 16));
    const auto texelAt = [&](double depth) { // metres along x of the slab
        const glm::dvec3 at = edge.scene.camera.eye + depth * edge.scene.camera.basis().forward;
        const glm::dvec3 left(-0.5, 0, at.z), right(0.5, 0, at.z);
        return 1 / (row->mapPoint(right).value().x - row->mapPoint(left).value().x);
    };
    const double first = texelAt(0.9 * edge.ends[1]);
    std::vector<AtSeam> seams;
    for (const double end : {edge.ends[1], edge.ends[2]})
        seams.push_back({halfWidth(edge, points, 0.8 * end, end) / LongEdge::half,
                         halfWidth(edge, points, end, 1.25 * end) / LongEdge::half, texelAt(0.9 * end) / first,
                         texelAt(1.1 * end) / first});
    return seams;
}

TEST(PcssVogel, APenumbraIsAsWideOnBothSidesOfASeamOfCascades) {
    for (const AtSeam& seam : atSeams("pcss-vogel:blockers=32,taps=32,cascades=3")) {
        EXPECT_GT(seam.texelBehind, 2 * seam.texelBefore);
        EXPECT_NEAR(seam.before, 1, 0.06);
        EXPECT_NEAR(seam.behind, 1, 0.06);
    }
}

TEST(PcssVogel, WidthsInTexelsGrowWithThoseOfACascade) { // bevy#22272
    for (const AtSeam& seam : atSeams("pcss-vogel:blockers=32,taps=32,cascades=3,widths=texels")) {
        EXPECT_NEAR(seam.before / seam.texelBefore, 1, 0.08);
        EXPECT_NEAR(seam.behind / seam.texelBehind, 1, 0.08);
    }
}

TEST(PcssVogel, AMapOfACascadeHoldsWhatHidesTheLightBesideTheView) {
    const Plate plate{2};
    Scene scene = plate.scene();
    scene.camera = {{-0.26, 1.4, 0.2}, {-0.26, 0, 0.2}, {0, 0, -1}, 40, 0.5, 40}; // straight down, as far as x = 0.25
    EXPECT_LT(fromDiskRamp(plate, scene, "pcss-vogel:blockers=32,taps=32,cascades=1", plate.half()), 0.03);
}

} // namespace
} // namespace shadowbench
