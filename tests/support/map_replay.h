// A depth map replayed in double precision on the CPU, with no rasteriser: what it holds at a texel's centre is found by
// intersecting that texel's line with every triangle. For checking figures in which the program contradicts a paper.
#pragma once

#include "groundtruth/contract/reference.h"
#include "scene/snapshot.h"
#include "techniques/shared/light_views/light_view.h"
#include "tests/support/world_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace shadowbench::test {

/// Of unit length, by pixel, row 0 at the top; zero where nothing is seen.
inline std::vector<glm::dvec3> geometricNormals(const Snapshot& snapshot, const groundtruth::PrimaryHits& hits) {
    std::map<std::uint32_t, std::pair<const Mesh*, glm::dmat4>> placements;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) placements[placement.id] = {batch.mesh.get(), placement.world};
    std::vector<glm::dvec3> normals;
    for (int y = 0; y < hits.surface.height(); ++y)
        for (int x = 0; x < hits.surface.width(); ++x) {
            normals.emplace_back(0);
            if (hits.surface(x, y) == groundtruth::Surface::Background) continue;
            const auto& [mesh, world] = placements.at(hits.id(x, y));
            const glm::uvec3 t = mesh->triangles[hits.triangle(x, y)];
            const auto corner = [&, m = mesh, w = world](std::uint32_t i) {
                return glm::dvec3(w * glm::dvec4(glm::dvec3(m->positions[i]), 1));
            };
            normals.back() = glm::normalize(glm::cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x)));
        }
    return normals;
}

/// A square map of `side` texels over `view`, with the slope bias that techniques have by default (factor 2, 64 units of
/// 2⁻²⁴).
class MapReplay {
public:
    MapReplay(const std::vector<WorldTriangle>& triangles, const techniques::LightView& view, int side)
        : clip_(view.clipFromWorld), side_(side) {
        const glm::dmat4 worldFromClip = glm::inverse(clip_);
        for (const auto& corners : triangles) {
            const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const glm::dvec4 plane =
                glm::dvec4(normal, -glm::dot(normal, corners[0])) * worldFromClip; // of clip space: dot(plane, h) = 0
            if (plane.z == 0) continue;                                            // seen edge-on
            add(corners, plane);
        }
    }

    /// Texels; x and y as texelAt gives them.
    [[nodiscard]] double nearestDepth(glm::dvec2 texel) const {
        const glm::dvec2 at = 2.0 * (glm::floor(texel) + 0.5) / static_cast<double>(side_) - 1.0; // the texel's centre, NDC
        double nearest = 1;
        for (const std::size_t i : cellAt(at)) {
            const Mapped& t = mapped_[i];
            const glm::dvec3 point(at, 1);
            if (inverseDepth(t, point) <= 0) continue;
            const double depth = 0.5 - 0.5 * glm::dot(t.depth, point) + t.bias;
            nearest = std::min(nearest, std::clamp(depth, 0.0, 1.0));
        }
        return nearest;
    }

    /// The same in metres from the light's plane, as maps of linear depth hold it; infinity where nothing is in the way. For
    /// views whose clip w is that depth.
    [[nodiscard]] double nearestLinearDepth(glm::dvec2 texel, double far) const {
        const glm::dvec2 at = 2.0 * (glm::floor(texel) + 0.5) / static_cast<double>(side_) - 1.0;
        const glm::dvec3 point(at, 1);
        double greatest = 0, slope = 0; // of 1 / depth
        for (const std::size_t i : cellAt(at)) {
            const Mapped& t = mapped_[i];
            const double inverse = inverseDepth(t, point);
            if (inverse <= greatest) continue;
            greatest = inverse;
            slope = 2.0 / side_ * std::max(std::abs(t.inverse.x), std::abs(t.inverse.y)) / (inverse * inverse);
        }
        return greatest > 0 ? 1 / greatest + factor * slope + 64.0 / (1 << 24) * far
                            : std::numeric_limits<double>::infinity();
    }

    /// The shadow test of Williams.
    [[nodiscard]] bool isLit(const glm::dvec3& world) const {
        const glm::dvec4 h = clip_ * glm::dvec4(world, 1);
        if (h.w <= 0) return true;
        const glm::dvec3 ndc = glm::dvec3(h) / h.w;
        return std::min(0.5 * ndc.z + 0.5, 1.0) <= nearestDepth((0.5 * glm::dvec2(ndc) + 0.5) * static_cast<double>(side_));
    }

private:
    static constexpr double factor = 2;

    struct Mapped {
        std::array<glm::dvec3, 3> edge; // dot(edge, (x, y, 1)) has one sign inside: homogeneous edge functions
        glm::dvec3 inverse;             // dot(inverse, (x, y, 1)) = 1 / w of the plane: negative behind the light
        glm::dvec3 depth;               // dot(depth, (x, y, 1)) = −z of the plane, NDC
        double bias;
        glm::dvec2 low, high; // NDC
    };

    /// 1 / w of the triangle at a point (x, y, 1); 0 beside it, not positive behind the light.
    static double inverseDepth(const Mapped& t, const glm::dvec3& point) {
        if (point.x < t.low.x || point.y < t.low.y || point.x > t.high.x || point.y > t.high.y) return 0;
        const glm::dvec3 e(glm::dot(t.edge[0], point), glm::dot(t.edge[1], point), glm::dot(t.edge[2], point));
        const bool inside = (e.x >= 0 && e.y >= 0 && e.z >= 0) || (e.x <= 0 && e.y <= 0 && e.z <= 0);
        return inside ? glm::dot(t.inverse, point) : 0;
    }

    void add(const WorldTriangle& corners, const glm::dvec4& plane) {
        std::array<glm::dvec3, 3> h; // x, y, w
        Mapped t{};
        t.low = glm::dvec2(std::numeric_limits<double>::infinity());
        t.high = -t.low;
        bool before = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec4 clip = clip_ * glm::dvec4(corners[i], 1);
            h[i] = {clip.x, clip.y, clip.w};
            before = before && clip.w > 0;
            t.low = glm::min(t.low, glm::dvec2(clip) / clip.w);
            t.high = glm::max(t.high, glm::dvec2(clip) / clip.w);
        }
        if (!before) { // it crosses the light's plane: no box bounds its image
            t.low = glm::dvec2(-std::numeric_limits<double>::infinity());
            t.high = -t.low;
        }
        for (std::size_t i = 0; i < 3; ++i) t.edge[i] = glm::cross(h[(i + 1) % 3], h[(i + 2) % 3]);
        t.inverse = (t.edge[0] + t.edge[1] + t.edge[2]) / glm::dot(h[0], t.edge[0]);
        t.depth = glm::dvec3(plane.x, plane.y, plane.w) / plane.z;
        const double perTexel = 2.0 / side_; // NDC; window depth is half of NDC's
        t.bias = factor * 0.5 * perTexel * std::max(std::abs(t.depth.x), std::abs(t.depth.y)) + 64.0 / (1 << 24);
        for (int y = cellOf(t.low.y); y <= cellOf(t.high.y); ++y)
            for (int x = cellOf(t.low.x); x <= cellOf(t.high.x); ++x) cells_[cellIndex(x, y)].push_back(mapped_.size());
        mapped_.push_back(t);
    }

    static std::size_t cellIndex(int x, int y) { return static_cast<std::size_t>(y) * across + static_cast<std::size_t>(x); }
    static int cellOf(double ndc) { return static_cast<int>(std::clamp((0.5 * ndc + 0.5) * across, 0.0, across - 1.0)); }

    /// The triangles whose boxes meet the cell of a grid that a point lies in.
    [[nodiscard]] const std::vector<std::size_t>& cellAt(glm::dvec2 ndc) const {
        return cells_[cellIndex(cellOf(ndc.x), cellOf(ndc.y))];
    }

    static constexpr int across = 32; // cells of the grid

    glm::dmat4 clip_;
    int side_;
    std::vector<Mapped> mapped_;
    std::vector<std::vector<std::size_t>> cells_{across * across};
};

} // namespace shadowbench::test
