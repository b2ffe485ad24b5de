#include "groundtruth/certify/pixel_certificate.h"

#include "base/error.h"
#include "groundtruth/oracle.h"
#include "scene/load/load.h"

#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

constexpr glm::ivec2 size{64, 64};

Snapshot shown(const char* id, const glm::dvec3& lightShift = glm::dvec3(0)) {
    const Scene scene = loadScene(id, Profile::Gate);
    Snapshot result = snapshot(scene, scene.timeline.still - 1);
    result.light = result.light.centreOnly();
    result.light.centre += lightShift;
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

/// Of pixel areas under a light that was moved, against the rays of the light where it is.
PixelCertificate certificateOfAMovedLight(const char* id, const glm::dvec3& shift) {
    const hard::ExactScene scene(shown(id));
    Reference labels;
    scene.labelByRays(size, scene.primaryHits(size), labels);
    return certifyPixels(scene, meansOf(shown(id, shift)), labels, pixelCertificatePoints, 2);
}

TEST(PixelCertificate, AcceptsAreasOfTheLightWhereItIs) {
    for (const char* id : {"dueling-frusta", "simple", "colonnade"}) {
        SCOPED_TRACE(id);
        const PixelCertificate found = certificateOfAMovedLight(id, glm::dvec3(0));
        EXPECT_EQ(found.contradicting, 0);
        EXPECT_LT(found.rms, 0.5 * found.independent);
        EXPECT_NO_THROW(requirePixelsCertified(found));
    }
}

TEST(PixelCertificate, RejectsALightMovedByAHundredthOfItsDistance) {
    for (const char* id : {"dueling-frusta", "simple", "colonnade"}) {
        SCOPED_TRACE(id);
        EXPECT_THROW(requirePixelsCertified(certificateOfAMovedLight(id, {0.1, 0, 0.1})), Inconclusive);
    }
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
