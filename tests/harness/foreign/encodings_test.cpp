// Encodings show in the values of grey pixels; errors of techniques do not.
#include "base/srgb.h"
#include "harness/foreign/encodings.h"
#include "tests/harness/foreign/exact_edges.h"

#include <gtest/gtest.h>
#include <random>

namespace shadowbench::foreign {
namespace {

float asItIs(float v) { return v; }

/// Several pixels of each fraction of `samples` that is not left out.
std::vector<float> filtered(int samples, int step = 1) {
    std::vector<float> values(40, 1.0F);
    for (int k = 0; k <= samples; k += step)
        values.insert(values.end(), 5, static_cast<float>(k) / static_cast<float>(samples));
    return values;
}

std::vector<float> changed(std::vector<float> values, float (*by)(float)) {
    std::ranges::transform(values, values.begin(), by);
    return values;
}

Image<float> changed(Image<float> v, float (*by)(float)) {
    std::ranges::transform(v, v.begin(), by);
    return v;
}

float in8Bits(float v) { return std::round(255 * v) / 255; }

bool seemsEncoded(const std::vector<float>& stored) {
    return isSure(encodedFractions(stored, srgbFromLinear), encodedFractions(stored, asItIs));
}
bool seemsDecoded(const std::vector<float>& stored) {
    return isSure(encodedFractions(stored, asItIs), encodedFractions(stored, srgbFromLinear));
}

TEST(EncodedFractions, AreFoundInAFilterOfAFewSamples) {
    for (const int samples : {4, 9, 16, 49, 64}) {
        const EncodedFractions found = encodedFractions(changed(filtered(samples), srgbFromLinear), srgbFromLinear);
        EXPECT_EQ(found.samples, samples);
        EXPECT_EQ(found.levels, samples - 1);
        EXPECT_TRUE(seemsEncoded(changed(filtered(samples), srgbFromLinear))) << samples;
        EXPECT_FALSE(seemsEncoded(filtered(samples))) << samples;
        EXPECT_TRUE(seemsDecoded(filtered(samples))) << samples;
        EXPECT_FALSE(seemsDecoded(changed(filtered(samples), srgbFromLinear))) << samples;
    }
}

TEST(EncodedFractions, AreFoundWhereOnlySomeOfThemAreThere) {
    EXPECT_TRUE(seemsEncoded(changed(filtered(9, 2), srgbFromLinear))) << "an image with few grey pixels";
}

TEST(EncodedFractions, AreFoundIn8BitsWhereEnoughOfThemAreThere) {
    for (const int samples : {9, 16}) {
        EXPECT_TRUE(seemsEncoded(changed(changed(filtered(samples), srgbFromLinear), in8Bits))) << samples;
        EXPECT_FALSE(seemsEncoded(changed(filtered(samples), in8Bits))) << samples;
    }
}

TEST(EncodedFractions, AreNotFoundByChance) {
    std::mt19937 random(1); // NOLINT: the same in every run
    std::uniform_real_distribution<float> any(0, 1);
    for (int trial = 0; trial < 200; ++trial)
        for (const bool bytes : {false, true}) {
            std::vector<float> values;
            for (int i = 0; i < 1 + 3 * trial; ++i) {
                const float v = bytes ? in8Bits(any(random)) : any(random);
                values.insert(values.end(), {v, v});
            }
            EXPECT_FALSE(seemsEncoded(values)) << trial;
            EXPECT_FALSE(seemsDecoded(values)) << trial;
        }
}

TEST(EncodedFractions, SayNothingWithoutGreyOrWithOneGrey) {
    EXPECT_FALSE(seemsEncoded({}));
    EXPECT_FALSE(seemsEncoded({0, 0, 1, 1}));
    EXPECT_FALSE(seemsEncoded({srgbFromLinear(0.5F), srgbFromLinear(0.5F)})) << "one level may be anything";
}

class EncodedEdges : public testing::Test {
protected:
    [[nodiscard]] bool suspect(const Image<float>& v, float (*undo)(float)) const {
        return isSuspect(greyPixels({v, edges_.truth, edges_.mask}, undo));
    }
    static Image<float> blurred(double width, double wrong = 0) {
        return ExactEdges::drawn(width, [wrong](double x, double y) { return distanceAt(x, y) + wrong; });
    }
    const ExactEdges edges_;
};

TEST_F(EncodedEdges, AreSuspectEitherWay) {
    for (const double width : {1.5, 3.0, 5.0}) {
        const Image<float> v = blurred(width);
        EXPECT_FALSE(suspect(v, linearFromSrgb)) << width;
        EXPECT_FALSE(suspect(v, srgbFromLinear)) << width;
        EXPECT_TRUE(suspect(changed(v, srgbFromLinear), linearFromSrgb)) << width;
        EXPECT_TRUE(suspect(changed(v, linearFromSrgb), srgbFromLinear)) << width;
    }
    EXPECT_FALSE(suspect(edges_.truth.visibility, linearFromSrgb)) << "no grey pixel";
}

TEST_F(EncodedEdges, AreNotSuspectWhereShadowsAreTooSmallOrTooLarge) {
    for (const double wrong : {-1.0, 1.0}) { // half a pixel and more, as biases move them
        EXPECT_FALSE(suspect(blurred(3, wrong), linearFromSrgb)) << wrong;
        EXPECT_FALSE(suspect(blurred(3, wrong), srgbFromLinear)) << wrong;
    }
}

} // namespace
} // namespace shadowbench::foreign
