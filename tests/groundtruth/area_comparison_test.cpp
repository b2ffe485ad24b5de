// A sampled truth against the exact one over the whole image.
#include "groundtruth/area_comparison.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

constexpr int width = 100;

/// A ramp from lit to umbra in the middle half of a row.
Reference ramp() {
    Reference reference;
    reference.visibility = Image<float>(width, 1);
    reference.sigma = Image<float>(width, 1, 0);
    reference.surface = Image<Surface>(width, 1, Surface::Receiver);
    for (int x = 0; x < width; ++x)
        reference.visibility[static_cast<std::size_t>(x)] =
            std::clamp(1.5F - 2 * (static_cast<float>(x) + 0.5F) / width, 0.0F, 1.0F);
    return reference;
}

/// The same with an error of ± 0.004 in the penumbra, which its certificate knows.
Reference sampled() {
    Reference reference = ramp();
    for (std::size_t x = 0; x < width; ++x) {
        float& v = reference.visibility[x];
        if (v > 0 && v < 1) v += x % 2 == 0 ? 0.004F : -0.004F;
    }
    reference.provenance.samples = 1024;
    reference.provenance.measured = {{"certificate_penumbra", 40}, {"certificate_rms", 0.004}};
    return reference;
}

bool refused(const Reference& reference) {
    try {
        requireNearExact(reference, ramp());
        return false;
    } catch (const Inconclusive& error) {
        return std::string(error.what()).find("nothing is scored against them") != std::string::npos;
    }
}

TEST(SampledTruth, PassesWithTheErrorThatItsCertificateFound) {
    EXPECT_NEAR(penumbraError(sampled(), ramp()).rms, 0.004, 1e-6);
    EXPECT_EQ(penumbraError(sampled(), ramp()).pixels, 50U);
    EXPECT_FALSE(refused(sampled()));
}

TEST(SampledTruth, IsInconclusiveWhereItIsWrongBetweenTheCertificatesPoints) {
    Reference spotted = sampled();
    for (std::size_t x = 0; x < 5; ++x) spotted.visibility[x] = 0; // lit: no penumbra was looked at there
    EXPECT_TRUE(refused(spotted));
    Reference doubled = sampled();
    doubled.provenance.measured["certificate_rms"] = 0.002;
    EXPECT_TRUE(refused(doubled));
}

TEST(SampledTruth, IsNotJudgedByAFewPenumbraPixels) {
    Reference few = sampled();
    few.provenance.measured = {{"certificate_penumbra", 5}, {"certificate_rms", 0}};
    EXPECT_FALSE(refused(few));
}

} // namespace
} // namespace shadowbench::groundtruth
