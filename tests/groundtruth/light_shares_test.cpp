// Exact shares of area lights against exact rays to random points of the lights. Many more of them, by other rays:
// benchmarks/light_shares.cpp.
#include "base/parallel.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/rays.h"
#include "groundtruth/oracle.h"
#include "scene/load/load.h"
#include "tests/support/area_scenes.h"
#include "tests/support/share_samples.h"

#include <string>

namespace shadowbench::groundtruth::testing {
namespace {

constexpr int samples = 4096;

/// Of the library, with its own light or the disk of the same sides.
Snapshot sceneWith(const std::string& id, LightKind kind) {
    const Scene scene = loadScene(id, Profile::Gate);
    Snapshot seen = snapshot(scene, scene.timeline.still - 1);
    seen.light.kind = kind;
    return seen;
}

/// By exact labels of `sampledShares` at one pixel.
std::array<int, 3> visibleAt(const Snapshot& scene, const SceneTriangles& triangles, const PrimaryHits& primary,
                             glm::ivec2 pixel, glm::ivec2 size) {
    const TriangleName own{triangles.instanceOf(primary.id(pixel.x, pixel.y)), primary.triangle(pixel.x, pixel.y)};
    const Triangle receiver = facing(triangles.triangle(own), scene.light.homogeneous());
    const ReceiverPoint point(pixelRay(scene.camera, pixel.x, pixel.y, size), receiver);
    const glm::dvec3 normal = glm::normalize(glm::cross(receiver[1] - receiver[0], receiver[2] - receiver[0]));
    const ShareSampler sampler(scene.light, point.rounded(), normal);
    const auto seed = static_cast<std::uint64_t>(size.x * pixel.y + pixel.x);
    return sampler.visibleOf(samples, seed, [&](const std::vector<glm::dvec3>& lights, std::vector<char>& seen) {
        for (std::size_t i = 0; i < lights.size(); ++i)
            seen[i] = shadowLabel(triangles, point, own, glm::dvec4(lights[i], 1)) == Blocking::Blocks ? 0 : 1;
    });
}

TEST(LightShares, AgreeWithExactRaysToRandomPointsOfTheLight) {
    const glm::ivec2 size(9, 9);
    int partly = 0;
    for (const auto& [id, kind] :
         std::vector<std::pair<std::string, LightKind>>{{"overlapping-occluders", LightKind::Rectangle},
                                                        {"large-light", LightKind::Disk},
                                                        {"soft-contact", LightKind::Rectangle}}) {
        const Snapshot scene = sceneWith(id, kind);
        const auto triangles = std::make_shared<const SceneTriangles>(scene);
        const PrimaryHits primary = ExactScene(scene, triangles).primaryHits(size);
        const AreaScene exact(scene, triangles);
        for (int i = 0; i < size.x * size.y; ++i) {
            const glm::ivec2 pixel(i % size.x, i / size.x);
            if (primary.surface(pixel.x, pixel.y) != Surface::Receiver) continue;
            const VisibleFraction area = exact.fraction(pixel, size, primary);
            if (area.low == 1 || area.high == 0) continue; // shares of all and of nothing are asserted elsewhere
            ++partly;
            const std::array<int, 3> visible = visibleAt(scene, *triangles, primary, pixel, size);
            for (std::size_t share = 0; share < 3; ++share) {
                const VisibleFraction f = exact.fraction(pixel, size, primary, sampledShares[share]);
                const double middle = 0.5 * (f.low + f.high);
                EXPECT_NEAR(static_cast<double>(visible[share]) / samples, middle, 4 * sampledSigma(middle, samples))
                    << id << " " << pixel.x << " " << pixel.y << " share " << share;
            }
        }
    }
    EXPECT_GT(partly, 20);
}

TEST(LightShares, AreReferencesOfTheirOwn) {
    const Snapshot scene = sceneWith("large-light", LightKind::Rectangle);
    const Reference area = compute({scene, {24, 24}, Truth::Area});
    for (const Truth truth : {Truth::Irradiance, Truth::SolidAngle}) {
        const Reference share = compute({scene, {24, 24}, truth});
        EXPECT_EQ(share.provenance.oracle, name(truth));
        EXPECT_EQ(share.provenance.samples, 0);
        double most = 0;
        for (std::size_t i = 0; i < area.visibility.size(); ++i) {
            ASSERT_EQ(share.surface[i], area.surface[i]);
            most = std::max(most, std::abs(static_cast<double>(share.visibility[i]) - area.visibility[i]));
            const bool whole = area.visibility[i] == 0 || area.visibility[i] == 1;
            if (whole) {
                EXPECT_EQ(share.visibility[i], area.visibility[i]);
            }
            EXPECT_LT(share.sigma[i], 1e-8);
        }
        EXPECT_GT(most, 0.005);
    }
}

} // namespace
} // namespace shadowbench::groundtruth::testing
