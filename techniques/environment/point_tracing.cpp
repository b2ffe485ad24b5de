#include "techniques/environment/point_tracing.h"

#include "base/parallel.h"
#include "techniques/environment/occlusion_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace shadowbench::techniques {
namespace {

/// Calls `work(i)` for each point, on all cores.
void forEachPoint(const SurfacePoints& points, const std::function<void(std::size_t begin, std::size_t end)>& work) {
    constexpr std::size_t part = 256;
    const std::size_t count = points.points.size();
    inParallel(static_cast<int>((count + part - 1) / part), availableThreads(), [&](int i) {
        const std::size_t begin = static_cast<std::size_t>(i) * part;
        work(begin, std::min(begin + part, count));
    });
}

std::vector<std::uint8_t> insidePoints(const SurfacePoints& points, const OcclusionRays& rays) {
    std::vector<std::uint8_t> inside(points.points.size());
    forEachPoint(points, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) inside[i] = rays.isInside(points.points[i]) ? 1 : 0;
    });
    return inside;
}

/// The points of a patch: from the first of its first row to the last of its last.
struct PointRange {
    std::uint32_t begin, end;
};

PointRange pointsOf(const SurfacePoints& points, const PointPatch& patch) {
    const PointRow &first = points.rows[patch.firstRow], &last = points.rows[patch.firstRow + patch.steps];
    return {first.first, last.first + last.steps + 1};
}

std::uint32_t nearestOutside(const SurfacePoints& points, const PointRange& range, const std::vector<std::uint8_t>& inside,
                             std::uint32_t point) {
    std::uint32_t nearest = point;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t other = range.begin; other < range.end; ++other) {
        const double distance = glm::distance(points.points[point].at, points.points[other].at);
        if (inside[other] != 0 || distance >= least) continue;
        least = distance;
        nearest = other;
    }
    return nearest;
}

std::vector<std::uint32_t> sourcesOf(const SurfacePoints& points, const std::vector<std::uint8_t>& inside) {
    std::vector<std::uint32_t> sources(points.points.size());
    std::iota(sources.begin(), sources.end(), 0U);
    for (const PointPatch& patch : points.patches) {
        const PointRange range = pointsOf(points, patch);
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            if (inside[i] != 0) sources[i] = nearestOutside(points, range, inside, i);
    }
    return sources;
}

} // namespace

std::vector<std::uint32_t> tracePoints(const SurfacePoints& points, const Snapshot& snapshot,
                                       std::span<const DirectionSample> directions, const PointVisit& visit) {
    const OcclusionRays rays(snapshot);
    std::vector<std::uint32_t> sources = sourcesOf(points, insidePoints(points, rays));
    forEachPoint(points, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> blocked(directions.size());
        for (std::size_t i = begin; i < end; ++i) {
            if (sources[i] != i) continue;
            rays.trace(points.points[i], directions, blocked);
            visit(i, blocked);
        }
    });
    return sources;
}

} // namespace shadowbench::techniques
