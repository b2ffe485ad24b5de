// Accuracy on images with known answers.
#include "base/error.h"
#include "harness/metrics/thresholds.h"
#include "tests/support/metrics_images.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;
using groundtruth::Reference;
using groundtruth::Surface;

constexpr int size = 32;
const HalfPlane vertical{{1, 0}, 16}; // the right half is lit

TEST(ReceiverMask, KeepsReceiversWhosePrimaryHitsAgree) {
    Reference truth = vertical.truth(10, 10);
    truth.surface(1, 0) = Surface::FacesAway;
    truth.surface(2, 0) = Surface::OnEdge;
    truth.surface(3, 0) = Surface::Background;
    truth.id(3, 0) = 0;
    const metrics::Drawn drawn{truth.id, truth.position};
    const metrics::Mask mask = metrics::receiverMask(truth, drawn, glm::dvec3(0));
    EXPECT_EQ(mask.count, 97);
    EXPECT_EQ(mask.primaryMismatch, 0);
    EXPECT_EQ(mask.scored(0, 0), 1);
    for (const int x : {1, 2, 3}) EXPECT_EQ(mask.scored(x, 0), 0) << x;
}

TEST(ReceiverMask, CountsAnotherSurfaceAnotherDistanceAndAMissedHitAsMismatch) {
    const Reference truth = vertical.truth(10, 10);
    metrics::Drawn drawn{truth.id, truth.position};
    drawn.id(0, 0) = 2;
    drawn.position(1, 0) = glm::vec3(0, 0, -1.0024F); // 0.24 %, above 0.2 % + 0.1 mm
    drawn.position(2, 0) = glm::vec3(0, 0, -1.0018F); // 0.18 %
    drawn.id(3, 0) = 0;
    drawn.position(4, 0) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    const metrics::Mask mask = metrics::receiverMask(truth, drawn, glm::dvec3(0));
    EXPECT_DOUBLE_EQ(mask.primaryMismatch, 0.04);
    EXPECT_EQ(mask.count, 96);
    EXPECT_EQ(mask.scored(2, 0), 1);
}

TEST(ReceiverMask, CountsBackgroundDrawnOverAsMismatch) {
    Reference truth = vertical.truth(10, 10);
    truth.id(0, 0) = 0;
    truth.surface(0, 0) = Surface::Background;
    metrics::Drawn drawn{truth.id, truth.position};
    drawn.id(0, 0) = 1;
    EXPECT_DOUBLE_EQ(metrics::receiverMask(truth, drawn, glm::dvec3(0)).primaryMismatch, 0.01);
}

TEST(ReceiverMask, ATinyImageMayDisagreeInAFewPixelsThatLieOnAnEdge) {
    Reference truth = vertical.truth(24, 24);
    for (int y = 0; y < 24; ++y)
        for (int x = 12; x < 24; ++x) truth.id(x, y) = 2;
    const auto aligned = [&](const std::vector<glm::ivec2>& pixels) {
        metrics::Drawn drawn{truth.id, truth.position};
        for (const glm::ivec2 p : pixels) drawn.id(p.x, p.y) = 3 - truth.id(p.x, p.y);
        return metrics::receiverMask(truth, drawn, glm::dvec3(0)).aligned;
    };
    EXPECT_TRUE(aligned({}));
    EXPECT_TRUE(aligned({{12, 3}})) << "1 of 576 is more than 0.1 %, and the other surface is a neighbour's";
    EXPECT_FALSE(aligned({{20, 3}})) << "no edge is near";
    EXPECT_FALSE(aligned({{12, 3}, {20, 3}}));
    EXPECT_TRUE(aligned({{12, 3}, {12, 4}, {11, 9}, {12, 12}}));
    EXPECT_FALSE(aligned({{12, 3}, {12, 4}, {12, 5}, {12, 6}, {12, 7}})) << "a camera beside the truth's";
}

TEST(ReceiverMask, ASurfaceOfOnePixelLiesOnAnEdgeOnlyWhereANeighbourShowsWhatIsDrawn) {
    Reference truth = vertical.truth(24, 24);
    truth.id(20, 3) = 2;
    metrics::Drawn drawn{truth.id, truth.position};
    drawn.position(20, 3) *= 1.01F;
    EXPECT_FALSE(metrics::receiverMask(truth, drawn, glm::dvec3(0)).aligned);
    drawn.id(20, 3) = 1;
    EXPECT_TRUE(metrics::receiverMask(truth, drawn, glm::dvec3(0)).aligned);
}

TEST(HardAccuracy, OfTheTruthItselfHasNoErrorAtAll) {
    const Reference truth = HalfPlane{{0.8, 0.6}, 20.3}.truth(size, size);
    const metrics::LabelErrors a = metrics::labelErrors({truth.visibility, truth, everything(truth)});
    EXPECT_EQ(a.mismatch, 0.0);
    EXPECT_EQ(a.mismatchOffEdge, 0.0);
    EXPECT_EQ(a.falseShadow, 0.0);
    EXPECT_EQ(a.leak, 0.0);
    const std::optional<metrics::EdgeError> edge = metrics::edgeError({truth.visibility, truth, everything(truth)});
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->mean, 0.0);
    EXPECT_EQ(edge->median, 0.0);
    EXPECT_EQ(edge->missing, 0);
    EXPECT_EQ(edge->islands, 0);
    EXPECT_EQ(edge->p95, 0.0);
    EXPECT_EQ(edge->hausdorff, 0.0);
    EXPECT_EQ(edge->signedMean, 0.0);
}

TEST(HardAccuracy, OfTheInvertedTruthIsWrongEverywhere) {
    const Reference truth = vertical.truth(size, size);
    const Image<float> inverted = imageOf(size, size, [](glm::dvec2 p) { return 1 - vertical.hard(p); });
    const metrics::LabelErrors a = metrics::labelErrors({inverted, truth, everything(truth)});
    EXPECT_EQ(a.mismatch, 1.0);
    EXPECT_EQ(a.falseShadow, 1.0);
    EXPECT_EQ(a.leak, 1.0);
}

TEST(HardAccuracy, OfOneFlippedPixelIsOneOverTheMask) {
    const Reference truth = vertical.truth(size, size);
    Image<float> v = truth.visibility;
    v(30, 5) = 0; // a lit pixel called shadowed
    const metrics::LabelErrors a = metrics::labelErrors({v, truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a.mismatch, 1.0 / (size * size));
    EXPECT_DOUBLE_EQ(*a.falseShadow, 2.0 / (size * size));
    EXPECT_EQ(a.leak, 0.0);
}

TEST(HardAccuracy, LeavesEdgePixelsOutOfTheOffEdgeMismatch) {
    const HalfPlane edge{{1, 0}, 16.3}; // the column of centre 16.5 is 0.2 px from the edge, its neighbours 0.8 and more
    const Reference truth = edge.truth(size, size);
    const Image<float> v = imageOf(size, size, [&](glm::dvec2 p) { return edge.moved(1).hard(p); });
    const metrics::LabelErrors a = metrics::labelErrors({v, truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a.mismatch, 1.0 / size); // exactly that column is wrong
    EXPECT_EQ(a.mismatchOffEdge, 0.0);
}

TEST(HardAccuracy, CountsAHalfAsLit) {
    const Reference truth = truthOf(4, 4, [](glm::dvec2) { return 1; });
    EXPECT_EQ(metrics::labelErrors({Image<float>(4, 4, 0.5F), truth, everything(truth)}).mismatch, 0);
    EXPECT_EQ(metrics::labelErrors({Image<float>(4, 4, 0.4999F), truth, everything(truth)}).mismatch, 1);
}

TEST(HardAccuracy, OfAShadowThatIsNotDarkHasAnErrorBeforeRounding) {
    const Reference truth = vertical.truth(size, size);
    const Image<float> v = imageOf(size, size, [](glm::dvec2 p) { return vertical.hard(p) > 0 ? 1 : 0.4; });
    const metrics::LabelErrors a = metrics::labelErrors({v, truth, everything(truth)});
    EXPECT_EQ(a.mismatch, 0.0);
    EXPECT_NEAR(*a.unrounded, 0.4 / 2, 1e-6);
    EXPECT_EQ(metrics::labelErrors({truth.visibility, truth, everything(truth)}).unrounded, 0.0);
}

TEST(HardAccuracy, LeavesAbsentWhatHasNoPixel) {
    const Reference truth = truthOf(8, 8, [](glm::dvec2) { return 1; });
    const metrics::LabelErrors a = metrics::labelErrors({truth.visibility, truth, everything(truth)});
    EXPECT_EQ(a.falseShadow, 0.0);
    EXPECT_FALSE(a.leak); // nothing is in shadow
    EXPECT_FALSE(metrics::edgeError({truth.visibility, truth, everything(truth)}));

    const metrics::Mask nothing{Image<std::uint8_t>(8, 8, 0), 0, 0};
    EXPECT_FALSE(metrics::labelErrors({truth.visibility, truth, nothing}).mismatch);
    EXPECT_FALSE(visibilityOf({truth.visibility, truth, nothing})["accuracy.rmse"]);
    metrics::Values values;
    const metrics::ScoredFrame frame{truth.visibility, truth, nothing};
    EXPECT_THROW(metrics::appendFrame<metrics::LabelsByFrame>(frame, values), BadInput);
    EXPECT_THROW(metrics::appendFrame<metrics::VisibilityByFrame>(frame, values), BadInput);
}

TEST(Accuracy, RefusesAVisibilityThatIsNotANumberInTheMaskOnly) {
    const Reference truth = vertical.truth(8, 8);
    Image<float> v = truth.visibility;
    v(2, 3) = std::numeric_limits<float>::quiet_NaN();
    metrics::Mask mask = everything(truth);
    EXPECT_THROW(metrics::labelErrors({v, truth, mask}), InternalError);
    EXPECT_THROW(visibilityOf({v, truth, mask}), InternalError);
    mask.scored(2, 3) = 0;
    --mask.count;
    EXPECT_NO_THROW(metrics::labelErrors({v, truth, mask}));
}

TEST(Accuracy, EveryMetricRefusesImagesOfAnotherSize) {
    const Reference truth = vertical.truth(8, 8);
    const metrics::Mask mask = everything(truth);
    const Image<float> wider(9, 8, 0.5F);
    const metrics::ScoredFrame frame{wider, truth, mask};
    EXPECT_THROW(metrics::labelErrors(frame), InternalError);
    EXPECT_THROW(metrics::labelledPixels(frame), InternalError);
    EXPECT_THROW(metrics::edgeError(frame), InternalError);
    EXPECT_THROW(metrics::penumbraWidthError(frame), InternalError);
    EXPECT_THROW(metrics::visibilityErrors(frame), InternalError);
    EXPECT_THROW(metrics::gradedPixels(frame), InternalError);
    EXPECT_THROW(metrics::umbra(frame), InternalError);
    EXPECT_THROW(metrics::grain(frame), InternalError);
    EXPECT_THROW(metrics::unresolved(frame), InternalError);
    EXPECT_THROW(metrics::ssim(frame), InternalError);
    EXPECT_THROW(metrics::pictureCorrectness(frame), InternalError);
}

TEST(EdgeError, OfAShiftByOnePixelIsOnePixelWithItsSign) {
    for (const double shift : {1.0, -1.0}) { // + : the edge moves into the lit half, the shadow grows
        const HalfPlane edge{{1, 0}, 16.3};
        const Reference truth = edge.truth(size, size);
        const Image<float> v = imageOf(size, size, [&](glm::dvec2 p) { return edge.moved(shift).hard(p); });
        const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
        ASSERT_TRUE(error);
        EXPECT_NEAR(*error->signedMean, shift, 1e-6) << "float distances";
        EXPECT_NEAR(*error->mean, 1, 1e-6);
        EXPECT_NEAR(*error->p95, 1, 1e-6);
        EXPECT_NEAR(*error->hausdorff, 1, 1e-6);
    }
}

TEST(EdgeError, OfAShiftWithoutADistanceFieldIsMeasuredBetweenTheLabels) {
    Reference truth = vertical.truth(size, size);
    truth.edgeDistance = Image<float>(size, size, std::numeric_limits<float>::infinity());
    for (const double shift : {3.0, -3.0}) {
        const Image<float> v = imageOf(size, size, [&](glm::dvec2 p) { return vertical.moved(shift).hard(p); });
        const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
        ASSERT_TRUE(error);
        EXPECT_DOUBLE_EQ(*error->signedMean, shift);
        EXPECT_DOUBLE_EQ(*error->mean, 3);
    }
}

TEST(EdgeError, WhereOneEdgeHasNoDistanceIsMeasuredBetweenTheLabels) {
    const HalfPlane edge{{1, 0}, 16};
    const Image<float> v = imageOf(32, 32, [&](glm::dvec2 p) { return edge.moved(3).hard(p); });
    for (const bool atExactEdge : {true, false}) {
        Reference truth = edge.truth(32, 32);
        for (float& distance : truth.edgeDistance)
            if ((distance < 2) != atExactEdge) distance = std::numeric_limits<float>::infinity();
        const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
        ASSERT_TRUE(error);
        EXPECT_NEAR(*error->mean, 3, 1e-6) << atExactEdge;
        EXPECT_NEAR(*error->signedMean, 3, 1e-6) << atExactEdge;
    }
}

TEST(EdgeError, WhereBothPixelsAreOnTheExactEdgeIsMeasuredFromHalfwayBetweenThem) {
    const HalfPlane edge{{1, 0}, 16};
    Reference truth = edge.truth(32, 32);
    for (float& distance : truth.edgeDistance)
        if (distance < 1) distance = 0;
    const Image<float> v = imageOf(32, 32, [&](glm::dvec2 p) { return edge.ramp(p, 4); }); // graded, and ½ on the edge
    const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
    ASSERT_TRUE(error);
    EXPECT_EQ(*error->mean, 0);
    EXPECT_EQ(error->missing, 0);
}

TEST(EdgeError, OfAGradedEdgeResolvesAQuarterOfAPixel) {
    for (const double shift : {0.25, -0.25}) {
        const HalfPlane edge{{0.8, 0.6}, 22.37};
        const Reference truth = edge.truth(size, size);
        const Image<float> v = imageOf(size, size, [&](glm::dvec2 p) { return edge.moved(shift).ramp(p, 6); });
        const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
        ASSERT_TRUE(error);
        EXPECT_NEAR(*error->signedMean, shift, 1e-5) << "both fields are linear: only float rounding is left";
        EXPECT_NEAR(*error->mean, 0.25, 1e-5);
    }
}

TEST(EdgeError, OfHardLabelsFindsAQuarterOfAPixelOnAverage) {
    const HalfPlane edge{glm::dvec2(std::cos(0.13), std::sin(0.13)),
                         140.37}; // slanted: every phase of the pixel grid occurs
    const Reference truth = edge.truth(256, 256);
    const Image<float> v = imageOf(256, 256, [&](glm::dvec2 p) { return edge.moved(0.25).hard(p); });
    const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
    ASSERT_TRUE(error);
    // About 290 labels, of which a share of 1/4 sees the shift: standard error √(¼ ¾ / 290) = 0.025 px were they
    // independent.
    EXPECT_NEAR(*error->signedMean, 0.25, 0.05);
}

TEST(EdgeError, CountsAShadowThatIsMissingFarAwayInTheHausdorffDistanceAndAsMissing) {
    const auto withPatch = [](glm::dvec2 p) { return p.x > 16 && !(p.x > 26 && p.y < 3) ? 1 : 0; };
    const Reference truth = truthOf(size, size, withPatch);
    const std::optional<metrics::EdgeError> error =
        metrics::edgeError({vertical.truth(size, size).visibility, truth, everything(truth)});
    ASSERT_TRUE(error);
    EXPECT_EQ(*error->mean, 0);
    EXPECT_NEAR(*error->hausdorff, std::hypot(15.5, 0.5),
                1e-12);                           // the patch's corner (31.5, 3) to the edge's sample (16, 2.5)
    EXPECT_NEAR(error->missing, 9.0 / 41, 1e-12); // of 32 samples of the one edge and 3 + 6 of the other
}

TEST(EdgeError, CountsIslandsApart) {
    const Reference truth = vertical.truth(size, size);
    Image<float> v = truth.visibility;
    v(25, 5) = v(26, 5) = v(25, 6) = 0; // acne
    v(28, 20) = 0;
    v(6, 9) = 1;   // a hole
    v(17, 28) = 0; // a step of the edge itself, 1.5 pixels beside it
    const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
    ASSERT_TRUE(error);
    EXPECT_EQ(error->islands, 3);
    EXPECT_EQ(error->missing, 0);
    EXPECT_EQ(error->median, 0);
    EXPECT_LE(*error->hausdorff, 2);
}

TEST(EdgeError, OfAnImageWithoutShadowIsMissingThroughout) {
    const Reference truth = vertical.truth(size, size);
    const std::optional<metrics::EdgeError> error =
        metrics::edgeError({Image<float>(size, size, 1), truth, everything(truth)});
    ASSERT_TRUE(error);
    EXPECT_EQ(error->missing, 1);
    EXPECT_EQ(error->islands, 0);
    EXPECT_FALSE(error->mean);
    EXPECT_FALSE(error->hausdorff);
}

TEST(EdgeError, IsMeasuredFromTheExactEdgeToo) {
    // The technique has half of the edge where it belongs and nothing else: what it has is right, half is missing.
    const Reference truth = vertical.truth(size, size);
    const Image<float> v = imageOf(size, size, [](glm::dvec2 p) { return p.y < 16 ? vertical.hard(p) : 1; });
    const std::optional<metrics::EdgeError> error = metrics::edgeError({v, truth, everything(truth)});
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->missing, 0.25, 0.05); // 8 of the 16 rows lie more than 8 pixels away
}

TEST(Thresholds, MoveWhatIsMissingAnIslandOnAnEdgeAndNearAPenumbra) {
    const Reference truth = vertical.truth(size, size);
    const Image<float> half = imageOf(size, size, [](glm::dvec2 p) { return p.y < 16 ? vertical.hard(p) : 1; });
    const auto missing = [&](double pixels) {
        return metrics::edgeErrorBy({.missingEdge = pixels}, {half, truth, everything(truth)})->missing;
    };
    EXPECT_EQ(missing(8), metrics::edgeError({half, truth, everything(truth)})->missing);
    EXPECT_NEAR(missing(4), 12.0 / 32, 1e-12); // of the 16 rows without an edge
    EXPECT_EQ(missing(16), 0);

    Image<float> acne = truth.visibility;
    acne(19, 5) = 0; // its centre lies 3.5 pixels from the edge
    const auto islands = [&](double pixels) {
        return metrics::edgeErrorBy({.island = pixels}, {acne, truth, everything(truth)})->islands;
    };
    EXPECT_EQ(islands(2), 1);
    EXPECT_EQ(islands(4), 0);
    const auto offEdge = [&](double pixels) {
        return *metrics::labelErrorsBy({.edgePixel = pixels}, {acne, truth, everything(truth)}).mismatchOffEdge;
    };
    EXPECT_GT(offEdge(3), 0);
    EXPECT_EQ(offEdge(4), 0);

    const Reference soft = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 4); });
    Image<float> beside = soft.visibility;
    for (int y = 0; y < size; ++y) beside(10, y) += 0.5F; // 4 columns from the penumbra's first
    const metrics::ScoredFrame frame{beside, soft, everything(soft)};
    EXPECT_EQ(metrics::penumbraErrorsBy({.neighbourhood = 3}, frame).dilated, 0);
    EXPECT_GT(*metrics::penumbraErrorsBy({.neighbourhood = 4}, frame).dilated, 0);
    EXPECT_GT(*metrics::umbraLeakBy({.neighbourhood = 3}, frame), 0);
    EXPECT_EQ(metrics::umbraLeakBy({.neighbourhood = 4}, frame), 0);
}

TEST(EdgeError, IgnoresBordersBetweenSurfaces) {
    Reference truth = vertical.truth(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 16; x < size; ++x) truth.id(x, y) = 2; // the labels differ only where the surface ends
    EXPECT_FALSE(metrics::edgeError({truth.visibility, truth, everything(truth)}));
}

TEST(SoftAccuracy, OfTheTruthItselfIsPerfect) {
    const Reference truth = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 8); });
    const metrics::Values a = visibilityOf({truth.visibility, truth, everything(truth)});
    EXPECT_EQ(a["accuracy.rmse"], 0.0);
    EXPECT_EQ(a["accuracy.mae"], 0.0);
    EXPECT_FALSE(a["accuracy.psnr"]); // infinite
    EXPECT_EQ(a["accuracy.bad30"], 0.0);
    EXPECT_EQ(a["accuracy.bad8"], 0.0);
    EXPECT_NEAR(*a["accuracy.ssim"], 1, 1e-12);
    EXPECT_EQ(a["accuracy.penumbra_rmse"], 0.0);
    EXPECT_EQ(a["accuracy.penumbra_width_error"], 0.0);
    EXPECT_EQ(a["accuracy.umbra_leak"], 0.0);
    EXPECT_FALSE(a["accuracy.unresolved"]); // exact truth
}

TEST(SoftAccuracy, OfAConstantErrorHasClosedForms) {
    const Reference truth = truthOf(size, size, [](glm::dvec2) { return 0.5; });
    const metrics::Values a = visibilityOf({Image<float>(size, size, 0.75F), truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a["accuracy.rmse"], 0.25);
    EXPECT_DOUBLE_EQ(*a["accuracy.mae"], 0.25);
    EXPECT_DOUBLE_EQ(*a["accuracy.psnr"], 20 * std::log10(4.0));
    EXPECT_EQ(a["accuracy.bad30"], 1.0);
    const double c1 = 1e-4; // (0.01)²; without variance only the luminance term is left
    EXPECT_NEAR(*a["accuracy.ssim"], (2 * 0.5 * 0.75 + c1) / (0.25 + 0.5625 + c1), 1e-12);
}

TEST(SoftAccuracy, CountsBadPixelsAboveTheirThresholdsOnly) {
    const Reference truth = truthOf(10, 10, [](glm::dvec2) { return 0; });
    Image<float> v(10, 10, 0);
    v(0, 0) = 31 / 255.0F;
    v(1, 0) = 29 / 255.0F;
    v(2, 0) = 7 / 255.0F;
    const metrics::Values a = visibilityOf({v, truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a["accuracy.bad30"], 0.01);
    EXPECT_DOUBLE_EQ(*a["accuracy.bad8"], 0.02);
    const Reference lit = truthOf(10, 10, [](glm::dvec2) { return 1; });
    for (float& value : v) value = 1 - value;
    const metrics::Values tooDark = visibilityOf({v, lit, everything(lit)});
    EXPECT_DOUBLE_EQ(*tooDark["accuracy.bad30"], 0.01);
    EXPECT_DOUBLE_EQ(*tooDark["accuracy.bad8"], 0.02);
}

TEST(SoftAccuracy, MeasuresInsideTheMaskOnly) {
    const Reference truth = truthOf(size, size, [](glm::dvec2) { return 0.5; });
    Image<float> v = truth.visibility;
    metrics::Mask mask = everything(truth);
    for (int x = 0; x < size; ++x) {
        v(x, 7) = 1;
        mask.scored(x, 7) = 0;
        --mask.count;
    }
    const metrics::Values a = visibilityOf({v, truth, mask});
    EXPECT_EQ(a["accuracy.rmse"], 0.0);
    EXPECT_NEAR(*a["accuracy.ssim"], 1, 1e-12);
}

TEST(Ssim, FallsWithNoise) {
    const Reference truth = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 8); });
    const auto noisy = [&](float amplitude) {
        Image<float> v = truth.visibility;
        for (std::size_t i = 0; i < v.size(); ++i) v[i] += (i * 7919 % 13 < 6 ? amplitude : -amplitude);
        return *metrics::ssim({v, truth, everything(truth)});
    };
    EXPECT_LT(noisy(0.02F), 1.0);
    EXPECT_LT(noisy(0.1F), noisy(0.02F));
    EXPECT_LT(noisy(0.1F), 0.7);
}

TEST(Ssim, OfConstantImagesIsTheTermOfTheMeansAndTurnsWithTheImage) {
    const auto ssimOf = [](const auto& v, const auto& exact) {
        const Reference truth = test::truthOf(24, 24, exact);
        return *metrics::ssim({test::imageOf(24, 24, v), truth, everything(truth)});
    };
    const auto quarter = [](glm::dvec2) { return 0.25; };
    const auto half = [](glm::dvec2) { return 0.5; };
    EXPECT_NEAR(ssimOf(half, quarter), (2 * 0.125 + 1e-4) / (0.3125 + 1e-4), 1e-6); // eq. 13 without variances
    const auto ramp = [](double x) { return 0.5 + 0.4 * std::sin(0.8 * x); };
    const auto step = [](double x) { return x > 12 ? 1.0 : 0.0; };
    const double along = ssimOf([&](glm::dvec2 p) { return ramp(p.x); }, [&](glm::dvec2 p) { return step(p.x); });
    const double down = ssimOf([&](glm::dvec2 p) { return ramp(p.y); }, [&](glm::dvec2 p) { return step(p.y); });
    EXPECT_NEAR(along, down, 1e-9);
}

// Around a lone lit pixel whose weight in a window is w, the means are w and 0, the variances w − w² and 0 (eqs. 13 to 16).
TEST(Ssim, OfALonePixelFallsOffWithTheGaussianOfOneAndAHalfPixels) {
    const Reference dark = truthOf(size, size, [](glm::dvec2) { return 0; });
    Image<float> v = dark.visibility;
    v(16, 16) = 1;
    double all = 0, sum = 0;
    const auto gauss = [](int x) { return std::exp(-x * x / (2 * 1.5 * 1.5)); };
    for (int x = -5; x <= 5; ++x) all += gauss(x);
    for (int y = -5; y <= 5; ++y)
        for (int x = -5; x <= 5; ++x) {
            const double w = gauss(x) * gauss(y) / (all * all), c1 = 1e-4, c2 = 9e-4;
            sum += 1 - c1 / (w * w + c1) * c2 / (w - w * w + c2);
        }
    EXPECT_NEAR(*metrics::ssim({v, dark, everything(dark)}), 1 - sum / (size * size), 1e-9);
}

TEST(PenumbraRmse, IsOfThePenumbraAloneAndTheDilatedOneOfTwoPixelsMore) {
    // Penumbra: the columns 14 … 17 (V* = 1/8, 3/8, 5/8, 7/8); with two more on each side 8 columns.
    const Reference truth = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 4); });
    const auto errorsOf = [&](int column) {
        Image<float> v = truth.visibility;
        for (int y = 0; y < size; ++y) v(column, y) += 0.5F;
        return visibilityOf({v, truth, everything(truth)});
    };
    EXPECT_NEAR(*errorsOf(14)["accuracy.penumbra_rmse"], std::sqrt(0.25 / 4), 1e-7);
    EXPECT_NEAR(*errorsOf(14)["accuracy.penumbra_rmse_dilated"], std::sqrt(0.25 / 8), 1e-7);
    EXPECT_EQ(*errorsOf(12)["accuracy.penumbra_rmse"], 0);
    EXPECT_NEAR(*errorsOf(12)["accuracy.penumbra_rmse_dilated"], std::sqrt(0.25 / 8), 1e-7);
    EXPECT_EQ(*errorsOf(11)["accuracy.penumbra_rmse_dilated"], 0);
    EXPECT_EQ(*errorsOf(11)["accuracy.pixels.penumbra"], 4 * size);
}

// The same picture with twice the pixels: a penumbra of w pixels is w of w + 4 when dilated and all of itself otherwise.
TEST(PenumbraRmse, OfAPictureWithTwiceThePixelsIsTheSame) {
    const auto errorsOf = [](int pixels) {
        const HalfPlane edge{{1, 0}, pixels / 2.0};
        const Reference truth = truthOf(pixels, pixels, [&](glm::dvec2 p) { return edge.ramp(p, pixels / 8.0); });
        Image<float> v = truth.visibility;
        for (float& value : v)
            if (value > 0 && value < 1) value = 0.5F;
        return visibilityOf({v, truth, everything(truth)});
    };
    const double exact = std::sqrt(1.0 / 12);                                  // rms of a ramp about its middle
    EXPECT_NEAR(*errorsOf(64)["accuracy.penumbra_rmse"], exact, 0.01 * exact); // sampled at 8 points
    EXPECT_NEAR(*errorsOf(128)["accuracy.penumbra_rmse"], exact, 0.01 * exact);
    EXPECT_NEAR(*errorsOf(64)["accuracy.penumbra_rmse_dilated"], exact * std::sqrt(8.0 / 12), 0.01 * exact);
    EXPECT_NEAR(*errorsOf(128)["accuracy.penumbra_rmse_dilated"], exact * std::sqrt(16.0 / 20), 0.01 * exact);
}

TEST(PenumbraRmse, IsAbsentForAHardTruth) {
    const Reference truth = vertical.truth(size, size);
    const metrics::Values a = visibilityOf({truth.visibility, truth, everything(truth)});
    EXPECT_FALSE(a["accuracy.penumbra_rmse"]);
    EXPECT_FALSE(a["accuracy.penumbra_width_error"]);
}

TEST(PenumbraWidth, OfARampTwiceAsWideHasError1InAnyDirection) {
    for (const double angle : {0.0, 0.4, 1.2}) {
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        const HalfPlane edge{normal, 64 * (normal.x + normal.y)};
        const Reference truth = truthOf(128, 128, [&](glm::dvec2 p) { return edge.ramp(p, 12); });
        const Image<float> wide = imageOf(128, 128, [&](glm::dvec2 p) { return edge.ramp(p, 24); });
        const Image<float> narrow = imageOf(128, 128, [&](glm::dvec2 p) { return edge.ramp(p, 6); });
        // Bilinear reading rounds the ramp's corners, which 0.1 and 0.9 lie 1.2 px (0.6 px for the narrow one) away from.
        EXPECT_NEAR(*metrics::penumbraWidthError({wide, truth, everything(truth)}), 1.0, 0.01) << angle;
        EXPECT_NEAR(*metrics::penumbraWidthError({narrow, truth, everything(truth)}), 0.5, 0.02) << angle;
    }
}

TEST(PenumbraWidth, OfAMissingShadowHasError1AndOfADisplacedOneNone) {
    const HalfPlane edge{{1, 0}, 64};
    const Reference truth = truthOf(128, 16, [&](glm::dvec2 p) { return edge.ramp(p, 12); });
    EXPECT_DOUBLE_EQ(*metrics::penumbraWidthError({Image<float>(128, 16, 1), truth, everything(truth)}), 1);
    const Image<float> displaced = imageOf(128, 16, [&](glm::dvec2 p) { return edge.moved(3).ramp(p, 12); });
    EXPECT_NEAR(*metrics::penumbraWidthError({displaced, truth, everything(truth)}), 0, 1e-6) << "float pixels";
}

TEST(PenumbraWidth, IsTheLengthFromATenthToNineTenths) {
    const HalfPlane edge{{1, 0}, 64};
    const Reference truth = truthOf(128, 16, [&](glm::dvec2 p) { return edge.ramp(p, 20); });
    const Image<float> tailed = imageOf(128, 16, [&](glm::dvec2 p) { // three times slower above 0.8
        const double ramp = 0.5 + edge.distance(p) / 20;
        return std::clamp(ramp > 0.8 ? 0.8 + (ramp - 0.8) / 3 : ramp, 0.0, 1.0);
    });
    // 0.1 to 0.8 is as long, 0.8 to 0.9 takes 0.3 instead of 0.1 of 20 px; pixels blunt the bend by less than a tenth of a
    // pixel.
    EXPECT_NEAR(*metrics::penumbraWidthError({tailed, truth, everything(truth)}), 0.2 / 0.8, 0.1 / 16);
}

TEST(PenumbraWidth, IsAbsentWhereThePenumbraLeavesTheImage) {
    const HalfPlane edge{{1, 0}, 64};
    const Reference truth = truthOf(128, 16, [&](glm::dvec2 p) { return edge.ramp(p, 300); });
    EXPECT_FALSE(metrics::penumbraWidthError({truth.visibility, truth, everything(truth)}));
}

TEST(UmbraLeak, IsTheMeanInTheUmbraTwoPixelsFromItsBorder) {
    const Reference truth = vertical.truth(size, size); // umbra: columns 0 … 15; eroded: columns 2 … 13, rows 2 … 29
    Image<float> v = truth.visibility;
    for (int y = 0; y < size; ++y) {
        v(13, y) = 0.6F;
        v(14, y) = 1; // next to the border: not counted
    }
    EXPECT_NEAR(*visibilityOf({v, truth, everything(truth)})["accuracy.umbra_leak"], 0.6 / 12, 1e-7);
}

TEST(Umbra, IsTheShareOfTheMaskWithoutLight) {
    const Reference truth = truthOf(size, size, [](glm::dvec2 p) { return p.x < 16 ? 0.0 : p.x < 20 ? 0.5 : 1.0; });
    Image<float> v = truth.visibility;
    for (int y = 0; y < size; ++y) {
        v(0, y) = 0.0019F; // less than half of 1/255: shown as 0
        v(1, y) = 0.0021F; // more
    }
    const metrics::Values a = visibilityOf({v, truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a["accuracy.umbra"], 15.0 / size);
    EXPECT_DOUBLE_EQ(*a["accuracy.true_umbra"], 16.0 / size);
    const Reference hard = truthOf(size, size, [](glm::dvec2 p) { return p.x < 8 ? 0.0 : 1.0; });
    EXPECT_FALSE(visibilityOf({hard.visibility, hard, everything(hard)})["accuracy.umbra"]);
}

TEST(Grain, TellsBandsFromNoise) {
    const Reference truth = truthOf(30, 12, [](glm::dvec2 p) { return std::clamp(p.x / 30, 0.05, 0.95); });
    const auto grainOf = [&](const auto& value) {
        const Image<float> v = imageOf(30, 12, value);
        return metrics::grain({v, truth, everything(truth)});
    };
    const auto ramp = [](glm::dvec2 p) { return 0.03 + 0.94 * p.x / 30; };
    EXPECT_EQ(*grainOf(ramp).plateau, 0);
    EXPECT_NEAR(*grainOf(ramp).noise, 0, 1e-6); // the middle of nine values of a ramp is its own

    // Bands of 5 pixels: of the 29 squares across the ramp the 5 that lie over a step are no plateau.
    const auto bands = [&](glm::dvec2 p) { return ramp({5 * std::floor(p.x / 5) + 2.5, 0}); };
    EXPECT_DOUBLE_EQ(*grainOf(bands).plateau, 24.0 / 29);
    EXPECT_EQ(*grainOf(bands).noise, 0);

    // Every fifth pixel of every other row is 0.1 off: one in nine of any 3 × 3 at most, so the median is the ramp's.
    const auto specks = [&](glm::dvec2 p) {
        return ramp(p) + (static_cast<int>(p.x) % 5 == 2 && static_cast<int>(p.y) % 4 == 1 ? 0.1 : 0.0);
    };
    EXPECT_EQ(*grainOf(specks).plateau, 0);
    EXPECT_GT(*grainOf(specks).noise, 0.002);
}

TEST(Grain, IsOfGradedPixelsOfOneSurfaceOnly) {
    Reference truth = truthOf(4, 4, [](glm::dvec2) { return 0.5; });
    const Image<float> v(4, 4, 0.5F);
    EXPECT_EQ(*metrics::grain({v, truth, everything(truth)}).plateau, 1);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) truth.id(x, y) = static_cast<std::uint32_t>(1 + x % 2);
    EXPECT_FALSE(metrics::grain({v, truth, everything(truth)}).plateau);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) truth.id(x, y) = static_cast<std::uint32_t>(1 + y % 2);
    EXPECT_FALSE(metrics::grain({v, truth, everything(truth)}).plateau) << "surfaces in rows";
    const Reference plain = truthOf(4, 4, [](glm::dvec2) { return 0.5; });
    for (const float full : {0.0F, 1.0F})
        EXPECT_FALSE(metrics::grain({Image<float>(4, 4, full), plain, everything(plain)}).noise) << full;
}

TEST(Grain, OfAPlateauIsUpToOneStepOfAByte) {
    const Reference truth = truthOf(2, 2, [](glm::dvec2) { return 0.5; });
    const auto plateau = [&](float step) {
        Image<float> v(2, 2, 0.25F);
        v(1, 1) += step;
        return *metrics::grain({v, truth, everything(truth)}).plateau;
    };
    EXPECT_EQ(plateau(0.998F / 255), 1);
    EXPECT_EQ(plateau(1.002F / 255), 0);
}

TEST(Unresolved, IsTheShareOfTheMaskWithinThreeSigma) {
    Reference truth = truthOf(10, 10, [](glm::dvec2) { return 0.5; });
    for (int x = 0; x < 10; ++x) truth.sigma(x, 0) = 0.01F;
    Image<float> v(10, 10, 0.5F);
    for (int x = 0; x < 5; ++x) v(x, 0) = 0.54F; // four sigma off: resolved
    EXPECT_DOUBLE_EQ(*visibilityOf({v, truth, everything(truth)})["accuracy.unresolved"], 0.05);
}

/// The visibility that a picture shows as this grey (Zápotocký's, of which 0.3 is ambient).
float shownAs(double grey) { return static_cast<float>((grey / 255 - 0.3) / 0.7); }

TEST(PictureCorrectness, CountsPixelsOfTheWholeFrameWhoseGreyIsNear) {
    Reference truth = truthOf(10, 10, [](glm::dvec2) { return shownAs(150); });
    Image<float> v = truth.visibility;
    int x = 0;
    for (const double steps : {2, 3, 8, 9, 16, 17, 30, 31}) v(x++, 0) = shownAs(150 + steps);
    v(0, 1) = shownAs(150 - 31);
    metrics::Mask mask = everything(truth);
    for (int y = 5; y < 10; ++y) // not scored, and yet of the frame: counted as equal
        for (int column = 0; column < 10; ++column) {
            v(column, y) = 1;
            mask.scored(column, y) = 0;
            --mask.count;
        }
    const metrics::Values a = visibilityOf({v, truth, mask});
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness_2"], 0.92);
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness"], 0.94);
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness_16"], 0.96);
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness_30"], 0.98);
}

TEST(PictureCorrectness, OfAMissingShadowIsTheShareThatHasNone) {
    // Umbra: columns 0 … 13. Penumbra: 14 … 17 (V* = 1/8, 3/8, 5/8, 7/8), the last of them 22 of 255 darker than light.
    const Reference truth = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 4); });
    const metrics::Values a = visibilityOf({Image<float>(size, size, 1), truth, everything(truth)});
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness"], 14.0 / size);
    EXPECT_DOUBLE_EQ(*a["accuracy.z_correctness_30"], 15.0 / size);
}

TEST(PictureCorrectness, OfTheTruthIsWholeAndOfAHardTruthAbsent) {
    const Reference soft = truthOf(size, size, [](glm::dvec2 p) { return vertical.ramp(p, 4); });
    EXPECT_EQ(visibilityOf({soft.visibility, soft, everything(soft)})["accuracy.z_correctness_2"], 1.0);
    const Reference hard = vertical.truth(size, size);
    EXPECT_FALSE(visibilityOf({hard.visibility, hard, everything(hard)})["accuracy.z_correctness"]);
}

} // namespace
} // namespace shadowbench
