// What is wrong with a whole image is named, and what is right or merely bad is not.
#include "base/srgb.h"
#include "harness/foreign/foreign_image.h"
#include "harness/foreign/recognition.h"
#include "tests/harness/foreign/exact_edges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

constexpr int side = 128;

/// Two shadows of different sizes and a bar, none of which is symmetric to anything. `blur`: half the width of their edges.
Image<float> shadows(double dx = 0, double dy = 0, double blur = 0.01) {
    Image<float> image(side, side, 1);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double px = x + 0.5 - dx, py = y + 0.5 - dy;
            const double disk = std::hypot(px - 40, py - 30) - 22, small = std::hypot(px - 98, py - 84) - 13;
            const double bar = std::max(std::abs(px - 30) - 7, std::abs(py - 95) - 19);
            const double distance = std::min({disk, small, bar}); // negative inside
            image(x, y) = static_cast<float>(std::clamp(0.5 + distance / (2 * blur), 0.0, 1.0));
        }
    return image;
}

class Recognition : public testing::Test {
protected:
    [[nodiscard]] Compared hard(const Image<float>& v) const { return {v, labels_, scored_, true}; }
    [[nodiscard]] Compared soft(const Image<float>& v) const { return {v, penumbrae_, scored_, false}; }

    [[nodiscard]] static std::string sentenceOf(const std::optional<Finding>& finding) {
        return finding ? finding->sentence : "";
    }
    static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

    const Image<float> labels_ = shadows(), penumbrae_ = shadows(0, 0, 6);
    const Image<float> filtered_ = shadows(0, 0, 1.5);
    const Image<std::uint8_t> scored_ = Image<std::uint8_t>(side, side, 1);
};

template <class From>
Image<float> made(From from) {
    Image<float> image(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) image(x, y) = from(x, y);
    return image;
}

TEST_F(Recognition, FindsNothingOddInRightAndSmoothedImages) {
    for (const Image<float>* image : {&labels_, &filtered_})
        EXPECT_TRUE(oddities(hard(*image), Encoding::Linear, {}).empty());
    EXPECT_TRUE(oddities(soft(penumbrae_), Encoding::Linear, {}).empty());
}

TEST_F(Recognition, FindsNothingOddInBadImages) {
    const Image<float> larger = made([&](int x, int y) { // every shadow two pixels too large, all round
        float least = 1;
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx)
                if (labels_.contains(x + dx, y + dy)) least = std::min(least, labels_(x + dx, y + dy));
        return least;
    });
    const Image<float> acne = made([&](int x, int y) { return (x + y) % 4 == 0 ? 0.0F : labels_(x, y); });
    for (const Image<float>* image : {&larger, &acne}) EXPECT_TRUE(oddities(hard(*image), Encoding::Linear, {}).empty());
}

TEST_F(Recognition, NamesEachWayOfTurningWithItsFigures) {
    const int last = side - 1;
    const std::pair<std::string, Image<float>> images[] = {
        {"upside down", made([&](int x, int y) { return filtered_(x, last - y); })},
        {"mirrored", made([&](int x, int y) { return filtered_(last - x, y); })},
        {"turned by half a turn", made([&](int x, int y) { return filtered_(last - x, last - y); })},
        {"transposed", made([&](int x, int y) { return filtered_(y, x); })},
        {"inverted", made([&](int x, int y) { return 1 - filtered_(x, y); })},
    };
    for (const auto& [words, image] : images) {
        const std::optional<Finding> found = turned(hard(image));
        ASSERT_TRUE(found) << words;
        EXPECT_TRUE(found->certain) << words;
        EXPECT_TRUE(has(found->sentence, "looks " + words)) << found->sentence;
        EXPECT_TRUE(has(found->sentence, " % to 0 % when")) << found->sentence;
        EXPECT_TRUE(turned(soft(image))) << words;
    }
}

TEST_F(Recognition, TakesAnImageThatShadowsItselfForNoInvertedOneForCertain) {
    const Image<float> acne = made([&](int x, int y) { return (x + 3 * y) % 16 == 0 ? labels_(x, y) : 0.0F; });
    const std::optional<Finding> found = turned(hard(acne)); // 84 % should be lit
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->certain) << found->sentence;
    EXPECT_TRUE(has(found->sentence, "looks inverted")) << found->sentence;
}

TEST_F(Recognition, NamesAShiftByAPixelEitherWay) {
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(2, -1)}) {
        for (const double blur : {0.01, 1.5}) {
            const std::optional<Finding> found = shifted(hard(shadows(dx, dy, blur)));
            ASSERT_TRUE(found) << dx << ' ' << dy << ' ' << blur;
            EXPECT_TRUE(found->certain) << found->sentence;
            EXPECT_TRUE(has(found->sentence, "shifted by (" + std::to_string(dx) + ", " + std::to_string(dy) + ")"))
                << found->sentence;
        }
        const std::optional<Finding> graded = shifted(soft(shadows(dx, dy, 6)));
        ASSERT_TRUE(graded) << dx << ' ' << dy;
        EXPECT_TRUE(graded->certain) << graded->sentence;
    }
}

TEST_F(Recognition, TakesNoShiftFromOneShadowThatIsElsewhere) {
    const Image<float> moved = shadows(1, 0);
    const Image<float> image = made([&](int x, int y) { return x > 80 ? moved(x, y) : labels_(x, y); }); // the small one
    EXPECT_FALSE(shifted(hard(image)));
}

TEST_F(Recognition, NamesEncodingsOfGradedTruthsForCertainAndOfSmoothedEdgesAsSuspected) {
    const auto encoded = [&](const Image<float>& v) { return made([&](int x, int y) { return srgbFromLinear(v(x, y)); }); };
    const auto decoded = [&](const Image<float>& v) { return made([&](int x, int y) { return linearFromSrgb(v(x, y)); }); };

    const std::optional<Finding> wrong = misencoded(soft(encoded(penumbrae_)), Encoding::Linear);
    ASSERT_TRUE(wrong);
    EXPECT_TRUE(wrong->certain);
    EXPECT_TRUE(has(wrong->sentence, "looks sRGB-encoded: the rms error falls from")) << wrong->sentence;
    const std::optional<Finding> twice = misencoded(soft(decoded(penumbrae_)), Encoding::Srgb);
    ASSERT_TRUE(twice);
    EXPECT_TRUE(has(twice->sentence, "say --linear")) << twice->sentence;

    const ExactEdges frame;
    const auto edgesOf = [&](const Image<float>& v, Encoding encoding) {
        const metrics::ScoredFrame known{v, frame.truth, frame.mask};
        return misencoded({v, frame.truth.visibility, frame.mask.scored, true, &known}, encoding);
    };
    const Image<float> smoothed = ExactEdges::drawn(3, distanceAt);
    const std::optional<Finding> edges = edgesOf(encoded(smoothed), Encoding::Linear);
    ASSERT_TRUE(edges);
    EXPECT_FALSE(edges->certain);
    EXPECT_TRUE(has(edges->sentence, "too bright on average")) << edges->sentence;
    EXPECT_TRUE(edgesOf(decoded(smoothed), Encoding::Srgb));
    EXPECT_FALSE(edgesOf(smoothed, Encoding::Linear));
    EXPECT_FALSE(edgesOf(encoded(labels_), Encoding::Linear)) << "0 and 1 are the same in both";
}

TEST_F(Recognition, NamesEncodingsOfAFilterOfAFewSamplesForCertain) {
    const Image<float> counted = made([&](int x, int y) { return std::round(9 * filtered_(x, y)) / 9; });
    const Image<float> encoded = made([&](int x, int y) { return srgbFromLinear(counted(x, y)); });
    const std::optional<Finding> found = misencoded(hard(encoded), Encoding::Linear);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->certain);
    EXPECT_TRUE(has(found->sentence, "sRGB-encoded: its grey values are those of a filter of 9 samples")) << found->sentence;
    EXPECT_FALSE(misencoded(hard(counted), Encoding::Linear));
}

TEST_F(Recognition, NamesBlackAndGreyImagesAndSuspectsWhiteOnes) {
    const auto all = [](float value) { return Image<float>(side, side, value); };
    const std::optional<Finding> black = uniform(hard(all(0)));
    ASSERT_TRUE(black);
    EXPECT_TRUE(black->certain);
    EXPECT_TRUE(has(black->sentence, "is black: no receiver has light, and 84 % of them should")) << black->sentence;
    EXPECT_TRUE(has(sentenceOf(uniform(hard(all(0.5F)))), "one grey"));
    const std::optional<Finding> white = uniform(hard(all(1)));
    ASSERT_TRUE(white);
    EXPECT_FALSE(white->certain) << "a renderer without shadows draws that";
    EXPECT_FALSE(uniform(hard(labels_)));
}

TEST_F(Recognition, NamesTheFrameThatAnImageIsOf) {
    const Image<float> next = shadows(5, 3);
    const std::optional<Finding> found = ofAnotherFrame(hard(next), {{60, next}, {61, shadows(9, 6)}});
    ASSERT_TRUE(found);
    EXPECT_TRUE(has(found->sentence, "looks like frame 60: mismatch falls from")) << found->sentence;
    EXPECT_FALSE(ofAnotherFrame(hard(labels_), {{60, next}}));
}

TEST_F(Recognition, SuspectsAShadedPicture) {
    const Image<float> picture = made([&](int x, int y) { return 0.6F * labels_(x, y); });
    const std::optional<Finding> found = shaded(hard(picture));
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->certain);
    EXPECT_FALSE(shaded(hard(labels_)));
}

TEST_F(Recognition, LooksAtReceiversAlone) {
    Image<std::uint8_t> scored(side, side, 1);
    Image<float> image = labels_;
    for (int y = 0; y < side; ++y)
        for (int x = 64; x < side; ++x) {
            scored(x, y) = 0;
            image(x, y) = 0.3F; // sky
        }
    EXPECT_TRUE(oddities({image, labels_, scored, true}, Encoding::Linear, {}).empty());
    EXPECT_EQ(errorOf({image, labels_, scored, true}), 0);
}

TEST(SizeInWords, SaysWhatAWrongSizeIsToTheRightOne) {
    EXPECT_EQ(sizeInWords({128, 128}, {256, 256}), "half the width and height");
    EXPECT_EQ(sizeInWords({512, 512}, {256, 256}), "2 times the width and height");
    EXPECT_EQ(sizeInWords({64, 48}, {48, 64}), "width and height swapped");
    EXPECT_EQ(sizeInWords({100, 90}, {256, 256}), "");
    EXPECT_EQ(sizeInWords({64, 48}, {50, 64}), "") << "one side alone is the other's";
    EXPECT_EQ(sizeInWords({64, 64}, {64, 64}), "");
}

} // namespace
} // namespace shadowbench::foreign
