#include "groundtruth/certify/pixel_certificate.h"

#include "base/error.h"
#include "groundtruth/oracle.h"
#include "scene/load/load.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
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

/// Of `means`, whatever they were made of, against the rays of the scene as it is.
PixelCertificate certificateOf(const char* id, const Reference& means, int points = pixelCertificatePoints,
                               std::uint16_t firstSet = 0) {
    const hard::ExactScene scene(shown(id));
    Reference labels;
    scene.labelByRays(size, scene.primaryHits(size), labels);
    return certifyPixels(scene, means, labels, points, 2, {}, firstSet);
}

std::string describe(const PixelCertificate& certificate) {
    std::string text;
    for (const auto& [key, value] : measured(certificate)) text += fmt::format("{} {:g}, ", key, value);
    return text;
}

constexpr const char* ids[] = {"dueling-frusta", "simple", "colonnade", "windmills"};

TEST(PixelCertificate, AcceptsAreasOfTheLightWhereItIs) {
    for (const char* id : ids) {
        const PixelCertificate found = certificateOf(id, meansOf(shown(id)));
        EXPECT_EQ(found.contradicting, 0) << id;
        EXPECT_LT(found.rms, 0.5 * found.independent) << id;
        EXPECT_NO_THROW(requirePixelsCertified(found)) << id << ": " << describe(found);
    }
}

TEST(PixelCertificate, AcceptsThemWhateverTheRays) {
    const Reference means = meansOf(shown("windmills"));
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
        const PixelCertificate found = certificateOf(id, moved(meansOf(shown(id)), 0.1));
        EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << id << ": " << describe(found);
    }
}

/// Where rays see most of each pixel's surface they err by less.
TEST(PixelCertificate, RejectsAnImageThatIsMovedByAFiftiethOfAPixel) {
    for (const char* id : {"dueling-frusta", "simple", "colonnade"}) {
        const PixelCertificate found = certificateOf(id, moved(meansOf(shown(id)), 0.02));
        EXPECT_THROW(requirePixelsCertified(found), Inconclusive) << id << ": " << describe(found);
    }
}

TEST(PixelCertificate, RejectsAreasThatLackACaster) {
    for (const char* id : ids) {
        Snapshot scene = shown(id);
        ASSERT_GT(scene.batches.size(), 1U) << id;
        scene.batches.pop_back();
        Reference means = meansOf(shown(id));
        const Reference without = meansOf(scene);
        for (std::size_t i = 0; i < means.id.size(); ++i)
            if (without.id[i] == means.id[i]) means.visibility[i] = without.visibility[i];
        EXPECT_THROW(requirePixelsCertified(certificateOf(id, means)), Inconclusive) << id;
    }
}

/// Errors that the former bound, 0.75 times that of independent rays, let pass.
TEST(PixelCertificate, RejectsErrorsOfTwiceWhatItsRaysErrBy) {
    Reference means = meansOf(shown("simple"));
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
    Reference means = meansOf(shown("windmills"));
    for (float& share : means.visibility)
        if (share > 0 && share < 1) share += share < 0.5F ? 0.3F : -0.3F;
    const PixelCertificate found = certificateOf("windmills", means);
    EXPECT_NEAR(found.impossible, 0.75 * found.points, 0.05 * found.points) << describe(found);
}

TEST(PixelCertificate, IsInTheProvenanceOfPixelAreas) {
    Request request{shown("dueling-frusta"), size};
    request.pixelAreas = true;
    const Reference found = compute(request);
    EXPECT_EQ(found.provenance.oracle, "pixel-areas");
    EXPECT_EQ(found.provenance.measured.at("certificate_points"), pixelCertificatePoints);
    EXPECT_EQ(found.provenance.measured.at("certificate_contradicting"), 0);
}

TEST(PixelCertificate, NoMeanOverPixelsIsMadeOfAnAreaLight) {
    const Scene scene = loadScene("simple", Profile::Gate);
    Request request{snapshot(scene, 0), size};
    request.pixelAreas = true;
    EXPECT_THROW(static_cast<void>(compute(request)), BadInput);
}

} // namespace
} // namespace shadowbench::groundtruth
