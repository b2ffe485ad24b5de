// The certificate on renders whose errors are known: made here, not by POV-Ray.
#include "base/error.h"
#include "base/random.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/certify/sky_certificate.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/povray/uncertainty.h"
#include "tests/support/certificates.h"
#include "tests/support/povray_scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {

using namespace area;
namespace {

constexpr int side = 128;
constexpr int samples = 1024;
constexpr double one = 1.0 / samples;

/// A ground whose left third is umbra, whose right third is lit, with a straight penumbra between them.
double ramp(int x) { return std::clamp(std::rint(samples * (3 * (x + 0.5) / side - 1)) / samples, 0.0, 1.0); }
VisibleFraction exactRamp(glm::ivec2 pixel) { return {ramp(pixel.x), ramp(pixel.x)}; }

PrimaryHits ground() {
    return {Image<std::uint32_t>(side, side, 1), Image<glm::vec3>(side, side), Image<Surface>(side, side, Surface::Receiver),
            Image<std::uint32_t>(side, side)};
}

/// A render of the ramp. `error` gives by how many samples all, the first half and the first quarter err at a penumbra
/// pixel.
template <typename Error>
povray::Render render(const Error& error) {
    povray::Render image{Image<float>(side, side), Image<float>(side, side), Image<float>(side, side),
                         Image<std::uint8_t>(side, side, 1), 1024};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double truth = ramp(x);
            const glm::dvec3 errors = truth > 0 && truth < 1 ? error(x, y) : glm::dvec3(0);
            image.visible(x, y) = static_cast<float>(truth + one * errors.x);
            image.firstHalf(x, y) = static_cast<float>(truth + one * errors.y);
            image.firstQuarter(x, y) = static_cast<float>(truth + one * errors.z);
        }
    }
    return image;
}

/// Signs by turns, so that there is no bias.
povray::Render honest() {
    return render([](int x, int y) { return ((x + y) % 2 == 0 ? 1.0 : -1.0) * glm::dvec3(2, 3, 5); });
}

Certificate certified(const povray::Render& image, int points = 512) {
    return certify(image, ground(), samples, points, 1, exactRamp);
}

void expectRejected(const povray::Render& image, const std::string& reason) {
    try {
        requireCertified(certified(image), samples);
        ADD_FAILURE() << "certified in spite of: " << reason;
    } catch (const Inconclusive& error) {
        EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
}

TEST(CertificatePoints, AreTheSameEachTimeAndMostlyInThePenumbra) {
    const povray::Render image = honest();
    const std::vector<glm::ivec2> points = certificatePoints(image, ground(), 512);
    EXPECT_EQ(points, certificatePoints(image, ground(), 512));
    ASSERT_EQ(points.size(), 512U);
    const auto in = [&](double low, double high) {
        return std::ranges::count_if(points, [&](glm::ivec2 p) { return ramp(p.x) >= low && ramp(p.x) <= high; });
    };
    EXPECT_GE(in(0.001, 0.999), 360); // three quarters, a twentieth of them on the neighbours of the penumbra
    EXPECT_GE(in(0, 0), 64);
    EXPECT_GE(in(1, 1), 64);
}

TEST(CertificatePoints, ReachEveryPartOfThePenumbra) {
    const std::vector<glm::ivec2> points = certificatePoints(honest(), ground(), 512);
    Image<int> hits(4, 8); // cells of 11 × 16 pixels in the middle third, about twelve points in each
    for (const glm::ivec2 p : points)
        if (const double v = ramp(p.x); v > 0 && v < 1) ++hits(static_cast<int>(4 * v), p.y / 16);
    EXPECT_GE(*std::ranges::min_element(hits), 6);
}

TEST(CertificatePoints, TakeFromTheOtherKindsWhatOneLacks) {
    povray::Render lit = honest();
    for (float& value : lit.visible) value = 1;
    EXPECT_EQ(certificatePoints(lit, ground(), 512).size(), 512U);
    EXPECT_EQ(certificatePoints(lit, ground(), 100000).size(), static_cast<std::size_t>(side * side)); // all there are
    EXPECT_TRUE(certificatePoints(lit, ground(), 0).empty());
}

TEST(CertificatePoints, SeeReceiversOnly) {
    PrimaryHits primary = ground();
    povray::Render image = honest();
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side / 2; ++y) primary.surface(x, y) = Surface::FacesAway;
        image.hit(x, side - 1) = 0;
    }
    for (const glm::ivec2 p : certificatePoints(image, primary, 512)) EXPECT_TRUE(p.y >= side / 2 && p.y < side - 1);
    for (Surface& surface : primary.surface) surface = Surface::Background;
    EXPECT_TRUE(certificatePoints(image, primary, 512).empty());
}

TEST(Certificate, MeasuresTheErrorsThatAreThere) {
    const Certificate c = certified(honest());
    EXPECT_EQ(c.points, 512);
    EXPECT_GT(c.penumbra, 360);
    EXPECT_EQ(c.wrong, 0);
    EXPECT_NEAR(c.rms, 2 * one, 1e-7); // float images
    EXPECT_NEAR(c.largest, 2 * one, 1e-7);
    EXPECT_NEAR(c.rmsHalf, 3 * one, 1e-7);
    EXPECT_NEAR(c.rmsQuarter, 5 * one, 1e-7);
    EXPECT_NEAR(c.bias, 0, 0.0003);                                 // a mean of some 370 signs: ± 0.002/√370, three times
    EXPECT_NEAR(c.independent, std::sqrt(1.0 / 6 / samples), 2e-4); // ∫ v(1 − v) dv = 1/6
    EXPECT_EQ(c.bracket, 0);
    requireCertified(c, samples);

    const Certificate shifted = certified(render([](int, int) { return glm::dvec3(1); }));
    EXPECT_NEAR(shifted.bias, one, 1e-7);
}

TEST(Certificate, HoldsTheMiddleOfABracketForTheFraction) {
    const ExactFraction wide = [](glm::ivec2 p) {
        return VisibleFraction{std::max(0.0, ramp(p.x) - 5e-5), std::min(1.0, ramp(p.x) + 5e-5)};
    };
    const Certificate c = certify(honest(), ground(), samples, 512, 1, wide);
    EXPECT_NEAR(c.bracket, 5e-5, 1e-9);
    EXPECT_EQ(c.penumbra, certified(honest()).penumbra); // the umbra's middle is not 0, but 0 lies in its bracket
    EXPECT_NEAR(c.rms, 2 * one, 1e-6);
}

TEST(Certificate, LeavesOutPointsThatSeeTheLightEdgeOn) {
    const ExactFraction none = [](glm::ivec2) { return VisibleFraction{0, 1}; };
    const Certificate c = certify(honest(), ground(), samples, 512, 1, none);
    EXPECT_EQ(c.points, 0);
    for (const double mean : {c.bias, c.rms, c.rmsHalf, c.rmsQuarter, c.independent, c.replayed}) EXPECT_EQ(mean, 0);
    requireCertified(c, samples);
}

/// A render of a ground without occluders in which each pixel lacks `missing` of 64 samples, against the exact oracle.
Certificate ofOpenGround(double lightHeight, int missing) {
    Request request{halfPlane(LightKind::Rectangle), {16, 16}};
    request.samples = 64;
    request.snapshot.batches.resize(1);
    const PrimaryHits primary = hard::primaryHits(request.snapshot, request.size);
    request.snapshot.light.centre.y = lightHeight;
    const Image<float> visible(16, 16, static_cast<float>(64 - missing) / 64);
    return certify(request, {visible, visible, visible, Image<std::uint8_t>(16, 16, 1), 1}, primary, 256, 1);
}

TEST(Certificate, WithoutPointsThatAreExactlyPartlyLitHasNoHonestRenders) {
    const Certificate lacking = ofOpenGround(3, 1);
    EXPECT_EQ(lacking.penumbra, 256) << "for the render";
    EXPECT_DOUBLE_EQ(lacking.bias, -1.0 / 64);
    EXPECT_DOUBLE_EQ(lacking.replayed, 1);
    EXPECT_FALSE(lacking.honest);
    const Certificate edgeOn = ofOpenGround(0, 0); // the light lies in the ground
    EXPECT_EQ(edgeOn.points, 0);
    EXPECT_EQ(edgeOn.replayed, 0);
    EXPECT_FALSE(edgeOn.honest);
}

TEST(Certificate, RejectsAFullyLitPixelThatIsInTheUmbra) {
    povray::Render image = honest();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < 10; ++x) image.visible(x, y) = 1; // a quarter of the umbra
    expectRejected(image, "fully lit or fully shadowed");
}

TEST(Certificate, RejectsSamplesOfUnequalWeight) {
    expectRejected(render([](int, int) { return glm::dvec3(0.4); }), "weights");
}

/// A certificate that meets its bounds: half of each.
Certificate withinBounds() {
    Certificate c;
    c.points = c.penumbra = 512;
    c.honest = HonestBounds{0.001, 0.004, 0.5};
    c.bias = 0.0005;
    c.rms = 0.002;
    c.rmsQuarter = 0.008;
    return c;
}

TEST(Certificate, PassesWithinTheBoundsOfHonestRenders) { requireCertified(withinBounds(), samples); }

TEST(Certificate, RejectsWhatOtherSampleSetsDoNotLeave) {
    const auto refused = [](auto&& change) {
        Certificate c = withinBounds();
        change(c);
        return rejection(requireCertified, c, samples);
    };
    EXPECT_NE(refused([](Certificate& c) { c.bias = -0.0013; }).find("mean error of -0.00130"), std::string::npos);
    EXPECT_NE(refused([](Certificate& c) { c.rms = 0.0043; }).find("is more than other sets"), std::string::npos);
    EXPECT_NE(refused([](Certificate& c) { c.rmsQuarter = 0.0034; }).find("does not fall"), std::string::npos);
    EXPECT_NE(refused([](Certificate& c) { c.replayed = 0.26; }).find("differ by 0.26 of 1024 samples"), std::string::npos);
}

TEST(Certificate, DoesNotJudgeByAFewPenumbraPixels) {
    povray::Render image = honest();
    const auto almostLit = [](glm::ivec2 p) {
        return p == glm::ivec2(64, 64) ? VisibleFraction{0.2, 0.2} : VisibleFraction{1, 1};
    };
    for (float& value : image.visible) value = 1;
    image.visible(64, 64) = 922.0F / samples; // an error of 0.70
    const Certificate c = certify(image, ground(), samples, side * side, 1, almostLit);
    EXPECT_EQ(c.penumbra, 1);
    EXPECT_NEAR(c.rms, 922.0 / samples - 0.2, 1e-6); // told …
    requireCertified(c, samples);                    // … and no reason to refuse the reference
}

TEST(Certificate, CalibratesTheUncertainty) {
    const povray::Render image = honest();
    const Certificate c = certified(image);
    const Image<float> sampled = povray::samplingUncertainty(image, ground().id, samples);
    const Image<float> sigma = calibrated(sampled, c, samples);
    double squares = 0;
    int penumbra = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            EXPECT_EQ(sigma(x, y) == 0, sampled(x, y) == 0);
            if (ramp(x) == 0 || ramp(x) == 1) continue;
            squares += sigma(x, y) * sigma(x, y);
            ++penumbra;
        }
    }
    EXPECT_NEAR(std::sqrt(squares / penumbra), 2 * one, 0.0001); // the rms error, known from 370 points of the 5,500

    Certificate exact = c;
    exact.rms = 0; // never better than a whole number of samples can be
    for (const float value : calibrated(sampled, exact, samples))
        EXPECT_TRUE(value == 0 || value == static_cast<float>(1 / (samples * std::sqrt(12.0))));
    Certificate few = c;
    few.penumbra = 5;
    EXPECT_EQ(calibrated(sampled, few, samples), sampled); // nothing to calibrate by
}

TEST(Certificate, NamesWhatItMeasured) {
    for (const auto& [key, value] : measured(certified(honest()))) {
        EXPECT_TRUE(key.starts_with("certificate_")) << key;
        EXPECT_TRUE(std::isfinite(value)) << key;
    }
}

TEST(SkyCertificate, AllowsFewerDirectionsLargerErrors) {
    Certificate c;
    c.points = 64;
    c.penumbra = 32;
    const auto refused = [&](int directions) { return rejection(requireSkyCertified, c, directions); };
    c.bias = -0.0011;
    EXPECT_NE(refused(usualDirections).find("its mean error over 32 partly lit points is -0.0011, more than 0.0010"),
              std::string::npos)
        << refused(usualDirections);
    EXPECT_NE(refused(2 * usualDirections), "");
    EXPECT_EQ(refused(usualDirections / 16), "") << "16^0.75 = 8 times as much";
    c.bias = 0.0081;
    EXPECT_NE(refused(usualDirections / 16), "");
    c.bias = 0;
    c.rms = 0.0051;
    c.rmsQuarter = 1;
    EXPECT_NE(refused(usualDirections).find("its rms error over 32 partly lit points is 0.0051, more than 0.0050"),
              std::string::npos);
    EXPECT_EQ(refused(usualDirections / 16), "");
    c.penumbra = 31;
    EXPECT_EQ(refused(usualDirections), "") << "too few to know it";
}

} // namespace
} // namespace shadowbench::groundtruth
