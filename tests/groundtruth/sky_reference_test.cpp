// The truth under environment lights: POV-Ray against closed forms and exact directions, and what its certificate refuses.
#include "base/error.h"
#include "groundtruth/certify/sky_certificate.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/oracle.h"
#include "groundtruth/sky_reference.h"
#include "tests/support/certificates.h"
#include "tests/support/povray_scene.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

const EnvironmentLight constantSky{ConstantSky{1}, {}};
const EnvironmentLight sunInSky{ConstantSky{1}, {Sun{glm::normalize(glm::dvec3(-0.6, 0.7, 0.4)), 10, 200}}};
const EnvironmentLight sunAlone{ConstantSky{0}, sunInSky.suns};

constexpr int few = 32; // points of a certificate that does not matter

Request under(const EnvironmentLight& light, Snapshot scene = overlappingPlates(), int samples = 1024) {
    scene.light = environmentLight(light);
    return {std::move(scene), {48, 48}, Truth::Soft, samples};
}

TEST(SkyReference, OfAHalfPlaneIsTheClosedForm) {
    const Request request = under(constantSky, halfPlane(LightKind::Point), 4096);
    const Reference reference = compute(request);
    EXPECT_EQ(reference.provenance.oracle, "povray");
    EXPECT_EQ(reference.provenance.samples, 4096);
    EXPECT_TRUE(reference.provenance.tools.contains("povray sky"));
    double squares = 0;
    int receivers = 0;
    for (std::size_t i = 0; i < reference.visibility.size(); ++i) {
        if (reference.surface[i] != Surface::Receiver || reference.id[i] != 1) continue;
        const glm::dvec3 p(reference.position[i]);
        if (std::hypot(p.x, p.z) > 6) continue; // the half-plane ends twenty metres away
        const double x = -p.x;                  // of its edge, one metre up
        const double error = static_cast<double>(reference.visibility[i]) - 0.5 * (1 + x / std::hypot(x, 1));
        squares += error * error;
        ++receivers;
        EXPECT_NEAR(error, 0, 0.008) << p.x << " " << p.z;
    }
    ASSERT_GT(receivers, 500);
    EXPECT_LT(std::sqrt(squares / receivers), 0.0025);
}

TEST(SkyReference, OfOpenGroundIsOneAndCertain) {
    Snapshot scene = overlappingPlates();
    scene.batches.pop_back();
    const Reference reference = compute(under(sunInSky, scene));
    for (std::size_t i = 0; i < reference.visibility.size(); ++i) {
        if (reference.id[i] == 0) continue;
        EXPECT_EQ(reference.surface[i], Surface::Receiver);
        EXPECT_EQ(reference.visibility[i], 1);
        EXPECT_EQ(reference.sigma[i], 0);
    }
}

TEST(SkyReference, LeavesOutWhatNoLightReaches) {
    const Request request = under(sunAlone);
    const Reference reference = measuredSky(request, few).reference;
    bool leftOut = false;
    const geometry::SceneTriangles triangles(request.snapshot);
    const PrimaryHits primary = hard::primaryHits(request.snapshot, request.size);
    const Image<glm::dvec3> normals = hard::seenNormals(request.snapshot, triangles, primary);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (primary.id[i] == 0) continue;
        const double cosine = glm::dot(normals[i], sunAlone.suns[0].direction);
        if (std::abs(cosine) < std::sin(glm::radians(5.1))) continue; // a part of the disk is above
        const bool faces = cosine > 0;
        EXPECT_EQ(reference.surface[i], faces ? Surface::Receiver : Surface::FacesAway);
        leftOut = leftOut || !faces;
    }
    EXPECT_TRUE(leftOut);
}

TEST(SkyReference, OfAnImageIsThatOfTheSunThatItShows) {
    ImageSky image{Image<float>(720, 360, 0)}; // half a degree a pixel
    const Sun& sun = sunAlone.suns[0];
    for (int y = 0; y < 360; ++y)
        for (int x = 0; x < 720; ++x)
            if (sun.contains(image.direction({x + 0.5, y + 0.5}))) image.radiance(x, y) = 100;
    const Reference ofImage = measuredSky(under({image, {}}), few).reference;
    const Reference ofSun = measuredSky(under(sunAlone), few).reference;
    double squares = 0;
    int receivers = 0;
    for (std::size_t i = 0; i < ofSun.visibility.size(); ++i) {
        if (ofSun.surface[i] != Surface::Receiver) continue;
        const double difference = static_cast<double>(ofImage.visibility[i]) - static_cast<double>(ofSun.visibility[i]);
        squares += difference * difference;
        ++receivers;
    }
    EXPECT_LT(std::sqrt(squares / receivers), 0.01); // pixels of a twentieth of the disk at its rim
}

TEST(SkyReference, ErrsLessWithMoreDirections) {
    for (const EnvironmentLight& light : {constantSky, sunInSky, sunAlone}) {
        double before = 1;
        for (const int samples : {128, 512, 2048}) {
            const Certificate c = measuredSky(under(light, overlappingPlates(), samples), 128).certificate;
            EXPECT_EQ(rejection(requireSkyCertified, c, samples), "") << samples << ": " << describe(c);
            EXPECT_LT(c.rms, 0.75 * before) << samples << ": " << describe(c);
            before = c.rms;
        }
    }
}

TEST(SkyReference, IsTheSameEachTime) {
    const Request request = under(sunInSky, overlappingPlates(), 256);
    const Reference a = measuredSky(request, few).reference, b = measuredSky(request, few).reference;
    EXPECT_EQ(a.visibility, b.visibility);
    EXPECT_EQ(a.sigma, b.sigma);
    EXPECT_EQ(a.provenance.measured, b.provenance.measured);
}

TEST(SkyReference, IsGivenByPovRayAlone) {
    for (const Truth truth : {Truth::Hard, Truth::PixelArea, Truth::Area, Truth::SolidAngle}) {
        Request request = under(constantSky);
        request.truth = truth;
        EXPECT_THROW(compute(request), BadInput) << name(truth);
    }
    Request request = under(constantSky);
    request.samples = povray::fewestLightSamples - 1;
    EXPECT_THROW(compute(request), BadInput);
}

TEST(ParallelLights, BringWhatTheLightBrings) {
    for (const int samples : {256, 1000, 1024}) {
        double sky = 0, sun = 0;
        std::array<int, 3> thirds{};
        const std::vector<povray::ParallelLight> lights = povray::parallelLights(sunInSky, samples);
        for (const povray::ParallelLight& light : lights) {
            (sunInSky.suns[0].contains(light.towards) && light.irradiance < 0.02 ? sun : sky) += light.irradiance;
            ++thirds[light.third];
        }
        EXPECT_NEAR(sky + sun, 4 * std::acos(-1.0) + 200 * sunInSky.suns[0].solidAngle(), 1e-9);
        const auto all = static_cast<double>(lights.size());
        EXPECT_NEAR(thirds[0] / all, 0.25, 0.01);
        EXPECT_NEAR(thirds[2] / all, 0.5, 0.01);
    }
    const SkySampler three({ConstantSky{1}, {Sun{}, Sun{}, Sun{}}});
    EXPECT_EQ(povray::directionCounts(three, 1024), (std::vector<int>{512, 256, 256, 256})); // never fewer of a sun
    EXPECT_EQ(povray::directionCounts(three, 6000), (std::vector<int>{3000, 1000, 1000, 1000}));
    EXPECT_EQ(povray::directionCounts(SkySampler(sunAlone), 1024), std::vector<int>{1024});
    EXPECT_EQ(povray::directionCounts(SkySampler(constantSky), 1024), std::vector<int>{1024});
}

/// What is refused, and where the recipe passes.
class SabotagedSky : public testing::Test {
protected:
    explicit SabotagedSky()
        : request_(under(sunInSky)), triangles_(std::make_shared<const geometry::SceneTriangles>(request_.snapshot)),
          primary_(hard::primaryHits(request_.snapshot, request_.size)), scene_(request_.snapshot, triangles_) {}

    [[nodiscard]] povray::Render render(const EnvironmentLight& light, const povray::SkyRecipe& recipe = {}) const {
        return povray::renderSky(under(light).snapshot, request_.samples,
                                 hard::seenNormals(request_.snapshot, *triangles_, primary_), {}, recipe)
            .image;
    }

    [[nodiscard]] std::string rejectionOf(const povray::Render& image, const EnvironmentLight& light = sunInSky) const {
        const Certificate c = certifySky(scene_, light, image, primary_, request_.samples, 128, 2);
        RecordProperty("certificate", describe(c));
        return rejection(requireSkyCertified, c, request_.samples);
    }

    Request request_;
    std::shared_ptr<const geometry::SceneTriangles> triangles_;
    PrimaryHits primary_;
    hard::ExactSky scene_;
};

TEST_F(SabotagedSky, TheRecipePasses) {
    EXPECT_EQ(rejectionOf(render(sunInSky)), "");
    EXPECT_EQ(rejectionOf(render(constantSky), constantSky), "");
}

TEST_F(SabotagedSky, WithoutTheCosineIsRefused) {
    const povray::Render flat = render(constantSky, {.brilliance = 0});
    EXPECT_NE(rejectionOf(flat, constantSky), "");
}

TEST_F(SabotagedSky, WithASteeperCosineIsRefused) {
    EXPECT_NE(rejectionOf(render(constantSky, {.brilliance = 1.1}), constantSky), "");
}

TEST_F(SabotagedSky, ATurnedSkyIsRefused) {
    EnvironmentLight turned = sunInSky;
    const glm::dvec3 sun = turned.suns[0].direction;
    turned.suns[0].direction = {sun.z, sun.y, -sun.x};
    EXPECT_NE(rejectionOf(render(turned)), "");
    EnvironmentLight mirrored = sunInSky;
    mirrored.suns[0].direction.x *= -1;
    EXPECT_NE(rejectionOf(render(mirrored)), "");
}

TEST_F(SabotagedSky, ASunOfAnotherBrightnessIsRefused) {
    EnvironmentLight dimmer = sunInSky;
    dimmer.suns[0].radiance *= 0.8;
    EXPECT_NE(rejectionOf(render(dimmer)), "");
}

TEST_F(SabotagedSky, LightFromBelowTheSurfaceIsRefused) {
    EXPECT_NE(rejectionOf(render(constantSky, {.doubleIlluminate = true}), constantSky), "");
}

TEST_F(SabotagedSky, DirectionsBelowTheTangentPlaneInTheWholeAreRefused) {
    povray::Render half = render(constantSky);
    for (Image<float>* image : {&half.visible, &half.firstHalf, &half.firstQuarter})
        for (float& v : *image) v *= 0.5F; // a constant sky has as much below as above
    EXPECT_NE(rejectionOf(half, constantSky), "");
}

TEST_F(SabotagedSky, AnUnscaledWorldOfMillimetresIsRefused) {
    constexpr double shrink = 4e-4;
    Request small = request_;
    for (glm::dvec3* vector : {&small.snapshot.camera.eye, &small.snapshot.camera.target}) *vector *= shrink;
    small.snapshot.camera.near *= shrink;
    small.snapshot.camera.far *= shrink;
    for (Batch& batch : small.snapshot.batches)
        for (Placement& placement : batch.placements)
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 3; ++row) placement.world[column][row] *= shrink;
    const MeasuredSky wrong = measuredSky(small, 128, {.largestScale = 1}), right = measuredSky(small, 128);
    EXPECT_NE(rejection(requireSkyCertified, wrong.certificate, small.samples), "") << describe(wrong.certificate);
    EXPECT_EQ(rejection(requireSkyCertified, right.certificate, small.samples), "") << describe(right.certificate);
}

} // namespace
} // namespace shadowbench::groundtruth
