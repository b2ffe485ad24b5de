// Scores at the thresholds that they have, and of images that do not belong together.
#include "base/error.h"
#include "harness/metrics/lod.h"
#include "harness/metrics/pixels.h"
#include "harness/metrics/thresholds.h"
#include "tests/support/metrics_images.h"

#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

using namespace test;
using groundtruth::Reference;
using groundtruth::Surface;

const HalfPlane vertical{{1, 0}, 16}; // the right half is lit

/// The mask of 100 × 100 receivers one metre away, of which `change` alters what is drawn.
Mask maskOf(const std::function<void(Drawn&)>& change) {
    const Reference truth = vertical.truth(100, 100);
    Drawn drawn{truth.id, truth.position};
    change(drawn);
    return receiverMask(truth, drawn, glm::dvec3(0));
}

TEST(ReceiverMask, TakesTwoThousandthsOfTheDistanceAndATenthOfAMillimetre) {
    const auto agrees = [](float distance) {
        return maskOf([&](Drawn& drawn) { drawn.position(5, 5) = {0, 0, -distance}; }).scored(5, 5) == 1;
    };
    EXPECT_TRUE(agrees(1.00205F));
    EXPECT_FALSE(agrees(1.00215F));
    EXPECT_TRUE(agrees(0.99795F));
    EXPECT_FALSE(agrees(0.99785F));
    EXPECT_FALSE(agrees(0.5F)) << "much nearer is another surface, too";
}

TEST(ReceiverMask, MeasuresDistancesFromTheEye) {
    const Reference truth = vertical.truth(10, 10);
    Drawn drawn{truth.id, truth.position};
    drawn.position(5, 5) = {0, 0, -1.1F};
    EXPECT_EQ(receiverMask(truth, drawn, {0, 0, 99}).scored(5, 5), 1) << "a thousandth of 100 m";
    EXPECT_EQ(receiverMask(truth, drawn, {0, 0, 9}).scored(5, 5), 0);
}

TEST(ReceiverMask, IsAlignedUpToAThousandthOfThePixels) {
    const auto aligned = [](int pixels) {
        return maskOf([&](Drawn& drawn) {
                   for (int i = 0; i < pixels; ++i) drawn.id(3 * i, 50) = 7;
               })
            .aligned;
    };
    EXPECT_TRUE(aligned(10));
    EXPECT_FALSE(aligned(11));
}

TEST(ReceiverMask, FindsAnEdgesOtherSurfaceATwentiethFurtherAtMost) {
    Reference truth = vertical.truth(10, 10);
    truth.id(4, 4) = 2; // drawn at its neighbour by corner
    const auto aligned = [&](int x, int y, float distance) {
        Drawn drawn{truth.id, truth.position};
        drawn.id(x, y) = 2;
        drawn.position(x, y) = {0, 0, -distance};
        return receiverMask(truth, drawn, glm::dvec3(0)).aligned;
    };
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) EXPECT_TRUE(aligned(4 + dx, 4 + dy, 1)) << dx << " " << dy;
    EXPECT_FALSE(aligned(6, 4, 1));
    EXPECT_FALSE(aligned(4, 6, 1));
    EXPECT_TRUE(aligned(5, 4, 1.045F));
    EXPECT_FALSE(aligned(5, 4, 1.055F));
}

TEST(ReceiverMask, RefusesImagesOfDifferentSizes) {
    const Reference truth = vertical.truth(8, 8);
    const Drawn drawn{truth.id, truth.position};
    const auto refuses = [](const Reference& t, const Drawn& d) {
        EXPECT_THROW((void)receiverMask(t, d, glm::dvec3(0)), InternalError);
    };
    refuses(truth, {Image<std::uint32_t>(8, 7), truth.position});
    refuses(truth, {truth.id, Image<glm::vec3>(7, 8)});
    Reference other = truth;
    other.surface = Image<Surface>(8, 7);
    refuses(other, drawn);
    other = truth;
    other.position = Image<glm::vec3>(7, 8);
    refuses(other, drawn);
    EXPECT_TRUE(receiverMask(Reference{}, Drawn{}, glm::dvec3(0)).aligned) << "nothing disagrees";
}

TEST(Scores, RefuseATruthOrMaskOfAnotherSize) {
    const Reference truth = vertical.truth(8, 8);
    const auto refuses = [&](const std::function<void(Reference&, Mask&)>& change) {
        Reference other = truth;
        Mask mask = everything(truth);
        change(other, mask);
        EXPECT_THROW(labelErrors({truth.visibility, other, mask}), InternalError);
    };
    refuses([](Reference& t, Mask&) { t.visibility = Image<float>(8, 7); });
    refuses([](Reference& t, Mask&) { t.id = Image<std::uint32_t>(8, 7); });
    refuses([](Reference& t, Mask&) { t.sigma = Image<float>(7, 8); });
    refuses([](Reference& t, Mask&) { t.edgeDistance = Image<float>(7, 8); });
    refuses([](Reference&, Mask& m) { m.scored = Image<std::uint8_t>(7, 8, 1); });
}

TEST(Scores, NameThePixelThatIsNoNumber) {
    const Reference truth = vertical.truth(8, 4);
    Image<float> v = truth.visibility;
    v(5, 2) = std::numeric_limits<float>::infinity();
    try {
        (void)labelErrors({v, truth, everything(truth)});
        FAIL();
    } catch (const InternalError& error) {
        EXPECT_NE(std::string(error.what()).find("of inf at pixel (5, 2)"), std::string::npos) << error.what();
    }
}

TEST(LabelErrors, ArePixelsWithinOneHalfOfAnEdgeOnIt) {
    Reference truth = vertical.truth(8, 1);
    for (int x = 0; x < 8; ++x) truth.edgeDistance(x, 0) = 0.25F * static_cast<float>(x);
    const LabelledPixels pixels = labelledPixels({truth.visibility, truth, everything(truth)});
    EXPECT_EQ(pixels.all, 8);
    EXPECT_EQ(pixels.lit + pixels.shadowed, 8);
    EXPECT_EQ(labelErrorsBy({.edgePixel = 1.5}, {Image<float>(8, 1, 1), truth, everything(truth)}).mismatchOffEdge, 1)
        << "1.5 itself lies on the edge";
    const Image<float> one = imageOf(8, 1, [](glm::dvec2 p) { return p.x > 6.9 && p.x < 8 ? 1 : 0; });
    EXPECT_EQ(labelErrorsBy({.edgePixel = 1.5}, {one, truth, everything(truth)}).mismatchOffEdge, 1);
    EXPECT_EQ(labelErrorsBy({.edgePixel = 1.49}, {one, truth, everything(truth)}).mismatchOffEdge, 0.5);
}

TEST(Quantile, IsTheLeastValueThatReachesTheShare) {
    std::vector<double> values{4, 1, 3, 2};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, 0.25), 1);
    EXPECT_EQ(quantile(values, 0.26), 2);
    EXPECT_EQ(quantile(values, 0.5), 2);
    EXPECT_EQ(quantile(values, 1), 4);
    EXPECT_EQ(mean(values), 2.5);
}

TEST(Bilinear, WeighsTheFourPixelsAround) {
    Image<float> image(2, 2);
    image(0, 0) = 1;
    image(1, 0) = 2;
    image(0, 1) = 4;
    image(1, 1) = 8;
    EXPECT_DOUBLE_EQ(Bilinear({0.75, 0.625})(image), 0.875 * (0.75 * 1 + 0.25 * 2) + 0.125 * (0.75 * 4 + 0.25 * 8));
    EXPECT_DOUBLE_EQ(Bilinear({0.5, 1.5})(image), 4) << "a centre has no neighbour";
    const Reference truth = truthOf(2, 2, [](glm::dvec2) { return 1; });
    Mask mask = everything(truth);
    EXPECT_TRUE(Bilinear({1.5, 1.5}).within(mask, truth.id, 1)) << "pixels of no weight may lie outside";
    EXPECT_FALSE(Bilinear({1.6, 1.5}).within(mask, truth.id, 1));
    EXPECT_FALSE(Bilinear({1, 1}).within(mask, truth.id, 2));
    mask.scored(0, 1) = 0;
    EXPECT_FALSE(Bilinear({1, 1}).within(mask, truth.id, 1));
    EXPECT_TRUE(Bilinear({1, 0.5}).within(mask, truth.id, 1));
}

TEST(NearestPixel, IsThatOfTheMaskAndTheSurface) {
    const Reference truth = truthOf(4, 2, [](glm::dvec2) { return 1; });
    Mask mask = everything(truth);
    mask.scored(2, 1) = 0;
    const ScoredFrame frame{truth.visibility, truth, mask};
    EXPECT_EQ(nearestPixel(frame, {3.9F, 1.1F}, 1), glm::ivec2(3, 1));
    EXPECT_EQ(nearestPixel(frame, {0, 0}, 1), glm::ivec2(0, 0));
    EXPECT_FALSE(nearestPixel(frame, {-0.1F, 0}, 1));
    EXPECT_FALSE(nearestPixel(frame, {0, 2}, 1));
    EXPECT_FALSE(nearestPixel(frame, {2.5F, 1.5F}, 1));
    EXPECT_FALSE(nearestPixel(frame, {0, 0}, 2));
    EXPECT_FALSE(isSomewhere({std::numeric_limits<float>::quiet_NaN(), 0}));
    EXPECT_FALSE(isSomewhere({0, std::numeric_limits<float>::quiet_NaN()}));
}

TEST(Crossings, LieBetweenNeighboursOfOneSurfaceInTheMask) {
    Reference truth = truthOf(3, 2, [](glm::dvec2 p) { return p.x < 1 ? 0.25 : 0.75; });
    Mask mask = everything(truth);
    const std::vector<Crossing> all = crossings(truth.visibility, truth, mask);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].a, glm::ivec2(0, 1));
    EXPECT_EQ(all[1].b, glm::ivec2(1, 1));
    EXPECT_DOUBLE_EQ(halfCrossing(truth.visibility, all[0]), 0.5);
    EXPECT_EQ(between(all[0], 0.25), glm::dvec2(0.75, 0.5));
    mask.scored(1, 1) = 0;
    EXPECT_EQ(crossings(truth.visibility, truth, mask).size(), 1U);
    mask.scored(0, 0) = 0;
    EXPECT_TRUE(crossings(truth.visibility, truth, mask).empty());
}

TEST(LodMetrics, SeeAChangeOfMoreThanThirtyInAnyChannelEitherWay) {
    const ColourImage plain(4, 4, glm::u8vec3(100));
    for (int channel = 0; channel < 3; ++channel)
        for (const int sign : {-1, 1}) {
            ColourImage now = plain;
            now(0, 3)[channel] = static_cast<std::uint8_t>(100 + sign * 30);
            EXPECT_EQ(largestChangedRegion(now, plain), 0U);
            now(0, 3)[channel] = static_cast<std::uint8_t>(100 + sign * 31);
            EXPECT_EQ(largestChangedRegion(now, plain), 1U);
        }
}

TEST(LodMetrics, ARegionReachesTheBorders) {
    const ColourImage black(5, 4, glm::u8vec3(0)), white(5, 4, glm::u8vec3(255));
    EXPECT_EQ(largestChangedRegion(black, white), 20U);
    ColourImage row = black;
    for (int x = 0; x < 5; ++x) row(x, 3) = {0, 0, 255};
    for (int y = 0; y < 3; ++y) row(4, y) = {0, 255, 0};
    EXPECT_EQ(largestChangedRegion(row, black), 8U);
}

TEST(LodMetrics, SpeckleIsTheDistanceFromTheMedianAroundAtBordersToo) {
    ColourImage image(3, 3, glm::u8vec3(50));
    image(0, 0) = {101, 50, 50}; // of the four around it the others are 50
    const Image<unsigned> everywhere(3, 3, 1);
    EXPECT_DOUBLE_EQ(speckle(image, everywhere), 51 / (3 * 255.0));
    image(2, 1) = {0, 50, 50};
    EXPECT_DOUBLE_EQ(speckle(image, everywhere), 101 / (3 * 255.0));
}

TEST(SeedErrors, AreAbsentWithoutReceivers) {
    const Reference truth = truthOf(2, 2, [](glm::dvec2) { return 1; });
    const std::vector<Image<float>> images(3, truth.visibility);
    const Mask nothing{Image<std::uint8_t>(2, 2, 0), 0, 0};
    EXPECT_FALSE(seedErrors({images, truth, nothing}));
    EXPECT_EQ(seedErrors({images, truth, everything(truth)})->rmse, 0);
}

TEST(SeedErrors, OfTwoSeedsHaveTheNoiseOfTheirDifference) {
    const Reference truth = truthOf(1, 1, [](glm::dvec2) { return 0.5; });
    const std::vector<Image<float>> images{Image<float>(1, 1, 0.5F), Image<float>(1, 1, 0.75F)};
    const SeedErrors found = *seedErrors({images, truth, everything(truth)});
    EXPECT_DOUBLE_EQ(found.bias, 0.125);
    EXPECT_DOUBLE_EQ(found.rmse, std::sqrt(0.03125));
    EXPECT_DOUBLE_EQ(found.noise, std::sqrt(0.03125));
    EXPECT_EQ(found.systematic, 0);
}

} // namespace
} // namespace shadowbench::metrics
