// Points spread over surfaces, and the rays that leave them.
#include "techniques/environment/surface_points.h"

#include "scene/meshes/primitives.h"
#include "scene/scene.h"
#include "techniques/environment/occlusion_rays.h"
#include "techniques/environment/point_tracing.h"
#include "tests/support/models/radiance_transfer.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <mutex>
#include <numeric>

namespace shadowbench::techniques {
namespace {

Placement placed(const glm::dmat4& world, std::uint32_t id) { return {world, world, id}; }

Batch batchOf(Mesh mesh, std::vector<Placement> placements) {
    return {std::make_shared<const Mesh>(std::move(mesh)), {}, false, std::move(placements)};
}

/// A right-angled triangle with sides of 4 m and 3 m in the plane y = 0, seen counter-clockwise from above.
Mesh triangle() { return {{{0, 0, 0}, {0, 0, 3}, {4, 0, 0}}, {{0, 1, 2}}, false}; }

/// The box with its middle at (0, 1, 0), sunk into the slab, whose top is y = 0.
Snapshot boxOnSlab() {
    Snapshot snapshot;
    snapshot.batches.push_back(batchOf(box({12, 0.2, 12}), {placed(glm::translate(glm::dmat4(1), {0, -0.1, 0}), 1)}));
    snapshot.batches.push_back(batchOf(box({2, 2.1, 2}), {placed(glm::translate(glm::dmat4(1), {0, 1, 0}), 2)}));
    return snapshot;
}

TEST(SurfacePoints, KeepToTheBudget) {
    for (const std::size_t budget : {200U, 2000U, 50000U}) {
        const SurfacePoints points = spreadPoints(boxOnSlab(), budget);
        EXPECT_LE(points.points.size(), budget);
        EXPECT_GE(points.points.size(), 3 * budget / 4);
    }
    EXPECT_EQ(spreadPoints(boxOnSlab(), 1).points.size(), 24U); // one a triangle
}

TEST(SurfacePoints, TrianglesSmallerThanTheSpacingHaveOneEachBesideTheBudget) {
    Snapshot snapshot = boxOnSlab();
    const double spacing = spreadPoints(snapshot, 2000).spacing;
    snapshot.batches.push_back(batchOf(sphere(0.2, 500), {placed(glm::translate(glm::dmat4(1), {3, 1, 0}), 3)}));
    const SurfacePoints points = spreadPoints(snapshot, 2000);
    EXPECT_NEAR(points.spacing, spacing, 0.01 * spacing);
    const std::size_t small = snapshot.batches[2].mesh->triangles.size();
    EXPECT_LE(points.points.size(), 2000 + small);
    EXPECT_GE(points.points.size(), 1500 + small);
}

TEST(SurfacePoints, NeighboursLieNoFartherApartThanTheSpacing) {
    const SurfacePoints points = spreadPoints(boxOnSlab(), 3000);
    for (const PointPatch& patch : points.patches) {
        for (std::uint32_t row = patch.firstRow; row <= patch.firstRow + patch.steps; ++row)
            for (std::uint32_t i = points.rows[row].first; i < points.rows[row].first + points.rows[row].steps; ++i)
                EXPECT_LE(glm::distance(points.points[i].at, points.points[i + 1].at), 1.001 * points.spacing);
        for (std::uint32_t row = patch.firstRow; row < patch.firstRow + patch.steps; ++row)
            EXPECT_LE(glm::distance(points.points[points.rows[row].first].at, points.points[points.rows[row + 1].first].at),
                      1.01 * points.spacing);
    }
}

TEST(SurfacePoints, ATriangleIsCoveredInRowsFromItsShortestEdge) {
    Snapshot snapshot;
    snapshot.batches.push_back(batchOf(triangle(), {placed(glm::dmat4(1), 1)}));
    const SurfacePoints points = spreadPoints(snapshot, 300);
    ASSERT_EQ(points.patches.size(), 2U); // an open mesh has two sides
    EXPECT_NEAR(points.patches[0].normal.y, 1, 1e-12);
    EXPECT_NEAR(points.patches[1].normal.y, -1, 1e-12);
    const PointPatch& patch = points.patches[0];
    EXPECT_EQ(patch.steps, static_cast<std::uint32_t>(std::ceil(5 / points.spacing)));          // the longest side
    EXPECT_EQ(points.rows[0].steps, static_cast<std::uint32_t>(std::ceil(3 / points.spacing))); // the shortest edge
    EXPECT_EQ(points.rows[patch.steps].steps, 0U);                                              // the corner opposite
    for (const SurfacePoint& point : points.points) {
        EXPECT_GE(std::min(point.at.x, point.at.z), 0);
        EXPECT_LE(point.at.x / 4 + point.at.z / 3, 1 + 1e-12);
    }
}

TEST(SurfacePoints, InterpolateWhatIsLinear) {
    Snapshot snapshot;
    snapshot.batches.push_back(batchOf(triangle(), {placed(glm::dmat4(1), 1)}));
    const SurfacePoints points = spreadPoints(snapshot, 300);
    const auto f = [](const glm::dvec3& p) { return 0.3 + 0.2 * p.x - 0.5 * p.z; };
    std::vector<double> values;
    for (const SurfacePoint& point : points.points) values.push_back(f(point.at));
    for (const glm::dvec3 p :
         {glm::dvec3(0.4, 0, 0.3), glm::dvec3(1.9, 0, 1.5), glm::dvec3(3.7, 0, 0.1), glm::dvec3(0, 0, 0)})
        EXPECT_NEAR(models::interpolated(points, points.patches[0], p, values), f(p), 1e-3); // they lie a little inside
}

TEST(SurfacePoints, AMirroredBodyHasItsOutsideWhereItIs) {
    Snapshot snapshot;
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1), {-1, 1, 1});
    snapshot.batches.push_back(batchOf(box({1, 1, 1}), {placed(glm::dmat4(1), 1), placed(mirror, 2)}));
    const SurfacePoints points = spreadPoints(snapshot, 200);
    EXPECT_EQ(points.surfaces[1].mirrored, 0U);
    EXPECT_EQ(points.surfaces[2].mirrored, 1U);
    EXPECT_EQ(points.surfaces[2].first, 12U);
    for (const SurfacePoint& point : points.points) EXPECT_GT(glm::dot(point.at, point.normal), 0.49);
}

TEST(OcclusionRays, MeetWhatTheModelMeets) {
    const Snapshot snapshot = boxOnSlab();
    const OcclusionRays rays(snapshot);
    const std::vector<DirectionSample> directions = evenSamples(500);
    const auto triangles = worldTriangles(snapshot);
    std::vector<std::uint8_t> blocked(directions.size());
    for (const SurfacePoint& point : {SurfacePoint{{1.7, 0, 0.3}, {0, 1, 0}}, SurfacePoint{{1, 0.9, 0.2}, {1, 0, 0}},
                                      SurfacePoint{{0.4, 2.05, 0.2}, {0, 1, 0}}}) {
        rays.trace(point, directions, blocked);
        const auto cosines = models::cosines(triangles, point, directions, 1e-4);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const bool above = glm::dot(glm::dvec3(directions[i].direction), point.normal) > 0;
            EXPECT_EQ(blocked[i] != 0, above && cosines[i] == 0) << i;
        }
    }
}

TEST(OcclusionRays, KnowWhatIsInsideABody) {
    const OcclusionRays rays(boxOnSlab());
    EXPECT_TRUE(rays.isInside({{0.3, 0, 0.2}, {0, 1, 0}}));     // the slab under the box
    EXPECT_FALSE(rays.isInside({{1.3, 0, 0.2}, {0, 1, 0}}));    // beside it
    EXPECT_TRUE(rays.isInside({{1, -0.04, 0.2}, {1, 0, 0}}));   // the box below the slab's top
    EXPECT_FALSE(rays.isInside({{0.3, 2.05, 0.2}, {0, 1, 0}})); // its own top
}

TEST(TracePoints, InsideABodyTakeTheTransferOfTheNearestPointOutside) {
    const Snapshot snapshot = boxOnSlab();
    const SurfacePoints points = spreadPoints(snapshot, 4000);
    std::vector<std::uint8_t> visited(points.points.size());
    std::mutex visiting;
    const auto sources =
        tracePoints(points, snapshot, evenSamples(64), [&](std::size_t point, std::span<const std::uint8_t>) {
            const std::lock_guard lock(visiting);
            ++visited[point];
        });
    std::size_t moved = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const glm::dvec3 &at = points.points[i].at, &of = points.points[sources[i]].at;
        EXPECT_EQ(visited[i], sources[i] == i ? 1 : 0);
        if (sources[i] == i) continue;
        ++moved;
        const bool underTheBox = std::abs(at.y) < 1e-3 && std::max(std::abs(at.x), std::abs(at.z)) < 1;
        const bool belowTheSlab = at.y < 0 && at.y > -0.06;
        EXPECT_TRUE(underTheBox || belowTheSlab) << at.x << " " << at.y << " " << at.z;
        EXPECT_FALSE(std::abs(of.y) < 1e-3 && std::max(std::abs(of.x), std::abs(of.z)) < 1);
        EXPECT_EQ(points.points[i].normal, points.points[sources[i]].normal);
    }
    EXPECT_GT(moved, 50U);
}

} // namespace
} // namespace shadowbench::techniques
