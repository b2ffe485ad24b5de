// References as the harness asks for them.
#include "base/error.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/oracle.h"
#include "groundtruth/povray/povray.h"
#include "groundtruth/reference_parts.h"
#include "tests/support/povray_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {

using namespace hard;
namespace {

constexpr glm::ivec2 size{96, 96};

constexpr bool contradicts(float a, float b) { return (a == 0 && b == 1) || (a == 1 && b == 0); }

Snapshot hardPlates() {
    Snapshot scene = overlappingPlates();
    scene.light = scene.light.centreOnly();
    return scene;
}

Request by(Oracle oracle, Snapshot scene) {
    Request request{std::move(scene), size};
    request.oracle = oracle;
    return request;
}

/// No plane anywhere: a finely cut ball.
Snapshot ball() {
    Snapshot scene = hardPlates();
    scene.batches.clear();
    scene.batches.push_back(placed(sphere(1.0, 5000), at({0, 1, 0}), 1));
    return scene;
}

TEST(Reference, OnSilhouettesOfATinyImageAFewHitsMayDiffer) {
    const Request request{ball(), {24, 24}};
    const PrimaryHits exact = primaryHits(request.snapshot, request.size);
    povray::Render image;
    image.hit = Image<std::uint8_t>(request.size.x, request.size.y, 0);
    for (std::size_t i = 0; i < exact.id.size(); ++i) image.hit[i] = exact.id[i] != 0;
    const auto flipped = [&](const std::vector<glm::ivec2>& pixels) {
        povray::Render changed = image;
        for (const glm::ivec2 p : pixels) changed.hit(p.x, p.y) ^= 1;
        requireSamePrimaryHits(request, changed, primaryMismatch(changed, exact));
    };
    std::vector<glm::ivec2> silhouette;
    for (int y = 0; y < 24; ++y)
        for (int x = 1; x < 24; ++x)
            if (image.hit(x, y) != image.hit(x - 1, y)) silhouette.emplace_back(x, y);
    ASSERT_GE(silhouette.size(), 5U);
    silhouette.resize(5);
    EXPECT_THROW(flipped(silhouette), InternalError) << "a camera beside the exact one";
    silhouette.pop_back();
    EXPECT_NO_THROW(flipped(silhouette));
    EXPECT_THROW(flipped({{0, 0}}), InternalError) << "no silhouette is near";
}

TEST(Reference, PovRayAndTheExactPrimaryHitsSeeTheSameGeometry) {
    const Snapshot scene = overlappingPlates();
    const PrimaryHits exact = primaryHits(scene, size);
    const povray::Render image = povray::render(scene, size, 16);
    int differing = 0, background = 0;
    for (std::size_t i = 0; i < exact.id.size(); ++i) {
        differing += (image.hit[i] != 0) != (exact.id[i] != 0);
        background += exact.id[i] == 0;
    }
    EXPECT_GT(background, 500);                   // else the test would see no silhouette
    EXPECT_LE(differing, size.x * size.y / 1000); // 0.1 %
}

/// Of overlappingPlates with 256 samples, computed once for all tests.
const Reference& softPlates() {
    static const Reference reference = compute({overlappingPlates(), size, Truth::Soft, 256});
    return reference;
}

TEST(Reference, OfAnAreaLightIsSoftCertifiedAndConfinedToReceivers) {
    const Reference& reference = softPlates();
    EXPECT_EQ(reference.provenance.oracle, "povray");
    EXPECT_EQ(reference.provenance.samples, 256);
    EXPECT_EQ(reference.provenance.key.size(), 32U);
    EXPECT_FALSE(reference.provenance.tools.at("povray").empty());
    EXPECT_LE(reference.provenance.measured.at("primary_mismatch"), 0.001);
    EXPECT_LE(reference.provenance.measured.at("light_mismatch"), 0.001);
    EXPECT_EQ(reference.provenance.measured.at("scale"), 1024);
    EXPECT_EQ(reference.provenance.measured.at("certificate_points"), certificatePointCount);
    EXPECT_GT(reference.provenance.measured.at("certificate_penumbra"), 300);
    EXPECT_EQ(reference.provenance.measured.at("certificate_wrong"), 0);
    EXPECT_LE(reference.provenance.measured.at("certificate_rms"), 0.01); // 256 samples: 0.003 at four times as many
    int soft = 0;
    for (std::size_t i = 0; i < reference.visibility.size(); ++i) {
        const float value = reference.visibility[i];
        ASSERT_TRUE(value >= 0 && value <= 1);
        ASSERT_TRUE(std::isinf(reference.edgeDistance[i]));
        ASSERT_TRUE(reference.surface[i] == Surface::Receiver || (value == 0 && reference.sigma[i] == 0));
        if (value > 0 && value < 1) {
            ++soft;
            ASSERT_GT(reference.sigma[i], 0);
        }
    }
    EXPECT_GT(soft, 200);
}

TEST(Reference, ALightMovedBehindPovRaysBackWouldBeNoticed) {
    // The exact label of the light's centre contradicts fully lit and fully shadowed pixels only if the lights differ.
    Snapshot moved = overlappingPlates();
    moved.light.centre += glm::dvec3(3, 0, 0);
    const povray::Render image = povray::render(moved, size, 64);
    Reference hard;
    labelByRays(hardPlates(), size, primaryHits(hardPlates(), size), hard);
    int contradictions = 0;
    for (std::size_t i = 0; i < hard.visibility.size(); ++i)
        contradictions += hard.surface[i] == Surface::Receiver && contradicts(image.visible[i], hard.visibility[i]);
    EXPECT_GT(contradictions, size.x * size.y / 100); // the bound of compute
}

TEST(Reference, OfAnAreaLightNeedsAnUncutView) {
    Request request{overlappingPlates(), {48, 48}, Truth::Soft, 16};
    request.snapshot.camera.far = 9; // the ground goes on behind
    EXPECT_THROW(compute(request), BadInput);
}

struct Honesty {
    double error = 0, sigma = 0; // rms over the penumbra
};

/// Error against the closed form beside the uncertainty that the reference states for it.
Honesty honesty(LightKind kind, int samples) {
    const Snapshot scene = halfPlane(kind);
    const Reference reference = compute({scene, size, Truth::Soft, samples});
    Honesty result;
    int count = 0;
    for (std::size_t i = 0; i < reference.visibility.size(); ++i) {
        const double x = reference.position[i].x;
        if (std::abs(x) >= 0.5) continue;
        const double edge = -2 * x;
        const double truth = kind == LightKind::Disk
                                 ? 0.5 + (edge * std::sqrt(1 - edge * edge) + std::asin(edge)) / std::acos(-1.0)
                                 : 0.5 * (edge + 1);
        result.error += std::pow(reference.visibility[i] - truth, 2);
        result.sigma += std::pow(reference.sigma[i], 2);
        ++count;
    }
    return {std::sqrt(result.error / count), std::sqrt(result.sigma / count)};
}

TEST(Reference, StatedUncertaintyIsTheError) {
    for (const LightKind kind : {LightKind::Rectangle, LightKind::Disk, LightKind::Line}) {
        for (const int samples : {64, 256, 1024}) {
            const Honesty h = honesty(kind, samples);
            RecordProperty(std::string(name(kind)) + std::to_string(samples),
                           std::to_string(h.error) + " sigma " + std::to_string(h.sigma));
            // The certificate knows the rms error from some 380 of the 3,000 penumbra pixels; neighbours err alike.
            EXPECT_NEAR(h.sigma / h.error, 1, 0.15) << name(kind) << " " << samples;
        }
    }
}

TEST(Reference, StatedUncertaintyHoldsWherePenumbraeOverlap) {
    const Reference& reference = softPlates();
    const povray::Render truth = povray::render(overlappingPlates(), size, 4096); // errs about six times less
    double error = 0, sigma = 0;
    int penumbra = 0, beyond = 0;
    for (std::size_t i = 0; i < reference.visibility.size(); ++i) {
        const float expected = truth.visible[i];
        if (reference.surface[i] != Surface::Receiver || expected == 0 || expected == 1) continue;
        const double difference = std::abs(reference.visibility[i] - expected);
        error += difference * difference;
        sigma += std::pow(reference.sigma[i], 2);
        beyond += difference > 3 * reference.sigma[i];
        ++penumbra;
    }
    ASSERT_GT(penumbra, 300);
    EXPECT_NEAR(std::sqrt(sigma / error), 1, 0.15); // as above
    EXPECT_LE(beyond, penumbra / 50); // a normal law has 0.3 % beyond 3σ; a window shares its σ among unlike pixels
}

TEST(Reference, OfAPointLightOnAGroundComesFromThePolygonOracle) {
    Snapshot scene = hardPlates();
    scene.batches.pop_back();
    const Reference reference = compute({scene, size});
    EXPECT_EQ(reference.provenance.oracle, "polygon");
    EXPECT_EQ(reference.provenance.samples, 0);
    EXPECT_FALSE(reference.provenance.tools.contains("povray"));
}

TEST(Reference, OfAnAreaLightsCentreIsThatOfAPointLight) {
    Snapshot centre = overlappingPlates();
    centre.light = centre.light.centreOnly();
    const Reference area = compute({overlappingPlates(), size, Truth::Hard}), point = compute({centre, size});
    EXPECT_EQ(area.visibility, point.visibility);
    EXPECT_EQ(area.provenance.key, point.provenance.key);
}

TEST(Reference, RaysAndAutoGiveTheSameLabels) {
    const Reference rays = compute(by(Oracle::Rays, hardPlates())), both = compute({hardPlates(), size});
    EXPECT_EQ(rays.provenance.oracle, "rays");
    int shadowed = 0;
    for (std::size_t i = 0; i < rays.visibility.size(); ++i) {
        if (rays.surface[i] != Surface::Receiver || both.surface[i] != Surface::Receiver) continue;
        ASSERT_EQ(rays.visibility[i], both.visibility[i]) << i;
        shadowed += rays.visibility[i] == 0;
    }
    EXPECT_GT(shadowed, 200);
}

TEST(Reference, ThePolygonOracleAloneLeavesReceiversWithoutAPlaneUnscored) {
    Snapshot scene = ball();
    scene.batches.push_back(placed(plane(20), glm::dmat4(1), 2));
    const Reference reference = compute(by(Oracle::Polygon, scene));
    EXPECT_EQ(reference.provenance.oracle, "polygon");
    EXPECT_EQ(compute({scene, size}).provenance.oracle, "polygon+rays");
    int ground = 0;
    for (std::size_t i = 0; i < reference.id.size(); ++i) {
        if (reference.surface[i] != Surface::Receiver) continue;
        EXPECT_EQ(reference.id[i], 2U);
        ++ground;
    }
    EXPECT_GT(ground, 1000);
}

TEST(Reference, OraclesThatCannotAnswerSaySo) {
    EXPECT_THROW(compute(by(Oracle::Polygon, ball())), BadInput);
    EXPECT_THROW(compute({hardPlates(), size, Truth::Soft}), BadInput);
    EXPECT_THROW(compute({hardPlates(), {0, 10}}), BadInput);
}

TEST(Reference, IsTheSameEachTime) {
    const Request request{overlappingPlates(), {48, 48}, Truth::Soft, 64};
    const Reference a = compute(request), b = compute(request);
    EXPECT_EQ(a.visibility, b.visibility);
    EXPECT_EQ(a.sigma, b.sigma);
    EXPECT_EQ(a.provenance.key, b.provenance.key);
}

TEST(Reference, ProgressNeverFallsBack) {
    std::vector<double> seen;
    compute({overlappingPlates(), {48, 48}, Truth::Soft, 16}, [&](double done, std::string_view) { seen.push_back(done); });
    ASSERT_FALSE(seen.empty());
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_LE(seen.back(), 1.0);
}

} // namespace
} // namespace shadowbench::groundtruth
