#include "groundtruth/certify/pixel_certificate.h"

#include "base/error.h"
#include "base/random.h"
#include "groundtruth/oracle.h"
#include "scene/load/load.h"
#include "tests/support/message_of.h"
#include "tests/support/povray_scene.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace shadowbench::groundtruth {
namespace {

constexpr glm::ivec2 size{64, 64};

Snapshot shown(const char* id) {
    const Scene scene = loadScene(id, Profile::Gate);
    Snapshot result = snapshot(scene, scene.timeline.still - 1);
    result.light = result.light.centreOnly();
    return result;
}

Reference meansOf(const Snapshot& snapshot) {
    const hard::ExactScene scene(snapshot);
    const PrimaryHits primary = scene.primaryHits(size);
    Reference means;
    scene.labelByRays(size, primary, means);
    scene.averageOverPixels(size, primary, means);
    return means;
}

/// A scene as it is, computed once for all tests.
struct Exact {
    explicit Exact(const std::string& id) : scene(shown(id.c_str())), means(meansOf(shown(id.c_str()))) {
        scene.labelByRays(size, scene.primaryHits(size), labels);
    }
    hard::ExactScene scene;
    Reference labels, means;
};

const Exact& exactOf(const std::string& id) {
    static std::map<std::string, Exact> scenes;
    return scenes.try_emplace(id, id).first->second;
}

/// Of `means`, whatever they were made of, against the rays of the scene as it is.
PixelCertificate certificateOf(const char* id, const Reference& means, int points = pixelCertificatePoints,
                               std::uint16_t firstSet = 0) {
    const Exact& exact = exactOf(id);
    return certifyPixels(exact.scene, means, exact.labels, points, 2, {}, firstSet);
}

std::string describe(const PixelCertificate& certificate) {
    std::string text;
    for (const auto& [key, value] : measured(certificate)) text += fmt::format("{} {:g}, ", key, value);
    return text;
}

constexpr const char* ids[] = {"dueling-frusta", "simple", "colonnade", "windmills"};

TEST(PixelCertificate, AcceptsAreasOfTheLightWhereItIs) {
    for (const char* id : ids) {
        const PixelCertificate found = certificateOf(id, exactOf(id).means);
        EXPECT_EQ(found.contradicting, 0) << id;
        EXPECT_LT(found.rms, 0.5 * found.independent) << id;
        EXPECT_NO_THROW(requirePixelsCertified(found)) << id << ": " << describe(found);
    }
}

TEST(PixelCertificate, AcceptsThemWhateverTheRays) {
    const Reference means = exactOf("windmills").means;
    for (std::uint16_t seed = 1; seed <= 20; ++seed) {
        const auto firstSet = static_cast<std::uint16_t>(seed * pixelCertificateSets);
        const PixelCertificate found = certificateOf("windmills", means, 48, firstSet);
        EXPECT_NO_THROW(requirePixelsCertified(found)) << seed << ": " << describe(found);
    }
}

TEST(PixelCertificate, RejectsALightMovedByAHundredthOfItsDistance) {
    for (const char* id : ids) {
        Snapshot scene = shown(id);
        Light& light = scene.light;
        const glm::dvec3 aside = 0.01 * glm::normalize(glm::dvec3(1, 0, 1));
        if (light.kind == LightKind::Point)
            light.centre += glm::distance(light.centre, scene.camera.target) * aside;
        else
            light.direction = glm::normalize(glm::normalize(light.direction) + aside);
        const PixelCertificate found = certificateOf(id, meansOf(scene));
        EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << id << ": " << describe(found);
    }
}

/// Blades so far away that a pixel sees dozens of them: its rays are as good as independent.
Snapshot grassFromAfar() {
    Random random(3);
    Mesh blades;
    for (std::uint32_t i = 0; i < 6'000; ++i) {
        const glm::vec3 foot(random.uniform(-3, 3), 0, random.uniform(-3, 3));
        const glm::vec3 side(random.uniform(-0.04, 0.04), 0, random.uniform(-0.04, 0.04));
        blades.positions.insert(blades.positions.end(),
                                {foot - side, foot + side, foot + glm::vec3(0, 0.15F, 0) + 3.0F * side});
        blades.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    Snapshot result = overlappingPlates();
    result.light = result.light.centreOnly();
    result.batches[1] = placed(blades, glm::dmat4(1), 2);
    return result;
}

TEST(PixelCertificate, AcceptsGrassSeenFromAfarAndRejectsItLit) {
    const hard::ExactScene scene(grassFromAfar());
    constexpr glm::ivec2 coarse(20, 20);
    const PrimaryHits primary = scene.primaryHits(coarse);
    Reference means, labels;
    scene.labelByRays(coarse, primary, means);
    labels = means;
    scene.averageOverPixels(coarse, primary, means);
    const PixelCertificate found = certifyPixels(scene, means, labels, pixelCertificatePoints, 2);
    EXPECT_GT(found.rms, 0.8 * found.independent) << describe(found);
    EXPECT_NO_THROW(requirePixelsCertified(found)) << describe(found);

    for (float& share : means.visibility)
        if (share > 0.1F && share < 0.9F) share += 0.05F;
    EXPECT_THROW(requirePixelsCertified(certifyPixels(scene, means, labels, pixelCertificatePoints, 2)), Inconclusive);
}

/// Pixel areas of the image moved by so many pixels to the right, where the pixel sees the same surface.
Reference moved(const Reference& means, double pixels) {
    Reference result = means;
    for (int y = 0; y < size.y; ++y)
        for (int x = 1; x < size.x; ++x) {
            const bool sameSurface = means.id(x, y) == means.id(x - 1, y) && means.surface(x - 1, y) == means.surface(x, y);
            const auto part = static_cast<float>(pixels);
            if (sameSurface) result.visibility(x, y) += part * (means.visibility(x - 1, y) - means.visibility(x, y));
        }
    return result;
}

TEST(PixelCertificate, RejectsAnImageThatIsMovedByATenthOfAPixel) {
    for (const char* id : ids) {
        const PixelCertificate found = certificateOf(id, moved(exactOf(id).means, 0.1));
        EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << id << ": " << describe(found);
    }
}

/// Where rays see most of each pixel's surface they err by less.
TEST(PixelCertificate, RejectsAnImageThatIsMovedByAFiftiethOfAPixel) {
    for (const char* id : {"dueling-frusta", "simple", "colonnade"}) {
        const PixelCertificate found = certificateOf(id, moved(exactOf(id).means, 0.02));
        EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << id << ": " << describe(found);
    }
}

TEST(PixelCertificate, RejectsAreasThatLackACaster) {
    for (const char* id : ids) {
        Snapshot scene = shown(id);
        ASSERT_GT(scene.batches.size(), 1U) << id;
        scene.batches.pop_back();
        Reference means = exactOf(id).means;
        const Reference without = meansOf(scene);
        for (std::size_t i = 0; i < means.id.size(); ++i)
            if (without.id[i] == means.id[i]) means.visibility[i] = without.visibility[i];
        EXPECT_THROW(requirePixelsCertified(certificateOf(id, means)), Inconclusive) << id;
    }
}

/// Errors that the former bound, 0.75 times that of independent rays, let pass.
TEST(PixelCertificate, RejectsErrorsOfTwiceWhatItsRaysErrBy) {
    Reference means = exactOf("simple").means;
    const PixelCertificate honest = certificateOf("simple", means);
    bool up = false;
    for (float& v : means.visibility)
        if (v > 0.05F && v < 0.95F) v += (up = !up) ? 0.012F : -0.012F;
    const PixelCertificate found = certificateOf("simple", means);
    EXPECT_LT(found.rms, 0.012);
    EXPECT_GT(found.rms, 2 * honest.rms);
    EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << describe(found);
}

// 1,024 rays of a share of ½ lie within 0.105 of it, by Bernstein's inequality at 10⁻⁵ over all points.
TEST(PixelCertificate, CountsPointsThatNoRaysCouldGive) {
    Reference means = exactOf("windmills").means;
    for (float& share : means.visibility)
        if (share > 0 && share < 1) share += share < 0.5F ? 0.3F : -0.3F;
    const PixelCertificate found = certificateOf("windmills", means);
    EXPECT_NEAR(found.impossible, 0.75 * found.points, 0.05 * found.points) << describe(found);
}

/// Of a ground that is lit everywhere, said to be lit by `share`; a pixel sees what lies below the ground.
PixelCertificate ofLitGround(float share) {
    Snapshot snapshot = halfPlane(LightKind::Rectangle);
    snapshot.light = snapshot.light.centreOnly();
    snapshot.batches[1] = placed(box({1, 1, 1}), at({0, -3, 0}), 2);
    Reference means;
    means.visibility = Image<float>(8, 8, share);
    means.sigma = Image<float>(8, 8);
    means.surface = Image<Surface>(8, 8, Surface::Receiver);
    means.id = Image<std::uint32_t>(8, 8, 1);
    means.id(3, 5) = 2;
    return certifyPixels(hard::ExactScene(snapshot), means, means, pixelCertificatePoints, 1);
}

// By Bernstein, 1,024 rays that are lit by a share 1 − d each are all lit once in 256/10⁻⁵ only where
// d = √(2 d (1 − d) L / 1024) + 2 L / 3072, L = ln(2 · 256/10⁻⁵): where d is 0.0534.
TEST(PixelCertificate, IsThatOfHand) {
    const PixelCertificate possible = ofLitGround(1 - 0.053F), impossible = ofLitGround(1 - 0.054F);
    EXPECT_EQ(possible.points, 63) << "no ray meets what one sees";
    EXPECT_EQ(possible.impossible, 0);
    EXPECT_EQ(impossible.impossible, 63);
    EXPECT_NEAR(possible.bias, -0.053, 1e-7);
    EXPECT_NEAR(possible.rms, 0.053, 1e-7);
    EXPECT_NEAR(possible.largest, 0.053, 1e-7);
    EXPECT_NEAR(possible.independent, std::sqrt(0.053 * 0.947 / 1024), 1e-7);
    EXPECT_NEAR(possible.excess, 0.053 * 0.053, 1e-7) << "all sets of rays say the same";
}

TEST(PixelCertificate, IsRefusedWithTheFirstBoundThatItBreaks) {
    const auto refused = [](const PixelCertificate& certificate) {
        return test::messageOf<Inconclusive>([&] { requirePixelsCertified(certificate); });
    };
    PixelCertificate c;
    c.points = 31; // too few for the bounds of the mean error and the excess
    c.independent = 0.02;
    c.rms = 0.014;
    EXPECT_NO_THROW(requirePixelsCertified(c));
    c.rms = 0.016;
    EXPECT_NE(refused(c).find("the rms error over 31 pixels is 0.0160, more than 0.75 times the 0.0200 of independent rays"),
              std::string::npos);
    c.expected = 0.01;
    EXPECT_NO_THROW(requirePixelsCertified(c)) << "its rays err as much";
    c.rms = 0.018;
    EXPECT_NE(refused(c).find("and 1.75 times the 0.0100 by which the rays themselves err"), std::string::npos);
    c.impossible = 1;
    c.largest = 0.25;
    EXPECT_NE(refused(c).find("1 of 31 pixels are further from their rays than rays can be, by up to 0.2500"),
              std::string::npos);
    c.contradicting = 2;
    EXPECT_NE(refused(c).find("2 pixels are fully lit or shadowed against their exact label"), std::string::npos);
}

TEST(PixelCertificate, IsInTheProvenanceOfPixelAreas) {
    Request request{shown("dueling-frusta"), size};
    request.truth = Truth::PixelArea;
    const Reference found = compute(request);
    EXPECT_EQ(found.provenance.oracle, "pixel-areas");
    EXPECT_EQ(found.provenance.measured.at("certificate_points"), pixelCertificatePoints);
    EXPECT_EQ(found.provenance.measured.at("certificate_contradicting"), 0);
}

TEST(PixelCertificate, NoMeanOverPixelsIsMadeOfAnEnvironment) {
    const Scene scene = loadScene("constant-sky", Profile::Gate);
    EXPECT_THROW(static_cast<void>(compute({snapshot(scene, 0), size, Truth::PixelArea})), BadInput);
}

} // namespace
} // namespace shadowbench::groundtruth
