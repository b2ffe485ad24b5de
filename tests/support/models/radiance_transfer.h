// What precomputed radiance transfer computes, in double precision: transfer by rays through every triangle, the sum over
// the points around a pixel, and the light of a sun that a receiver sees.
#pragma once

#include "scene/sky.h"
#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"
#include "tests/support/world_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <span>
#include <vector>

namespace shadowbench::models {

using techniques::DirectionSample;
using techniques::PointPatch;
using techniques::PointRow;
using techniques::SurfacePoint;
using techniques::SurfacePoints;

/// Whether the ray meets the triangle (Möller and Trumbore 1997).
inline bool meets(const WorldTriangle& t, const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0], p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return false;
    const glm::dvec3 s = from - t[0], q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / determinant > 0;
}

/// max(normal · s, 0) V(s) for each direction, from a point `lift` metres above its surface.
inline std::vector<double> cosines(std::span<const WorldTriangle> triangles, const SurfacePoint& point,
                                   std::span<const DirectionSample> directions, double lift) {
    std::vector<double> result;
    for (const DirectionSample& sample : directions) {
        const glm::dvec3 direction(sample.direction);
        const double cosine = glm::dot(direction, point.normal);
        const glm::dvec3 from = point.at + lift * point.normal;
        const bool dark =
            cosine <= 0 || std::ranges::any_of(triangles, [&](const WorldTriangle& t) { return meets(t, from, direction); });
        result.push_back(dark ? 0 : cosine);
    }
    return result;
}

/// The two of `steps` + 1 values between which a share of the way lies, and the weight of the second.
struct Between {
    std::size_t first, second;
    double weight;
};

inline Between between(double share, unsigned steps) {
    const double position = std::clamp(share, 0.0, 1.0) * steps;
    const std::size_t first = std::min<std::size_t>(static_cast<std::size_t>(position), steps - std::min(steps, 1U));
    return {first, std::min<std::size_t>(first + 1, steps), position - static_cast<double>(first)};
}

/// `values` of the points of a patch, interpolated along its rows and between them (environment/lookup.frag).
inline double interpolated(const SurfacePoints& points, const PointPatch& patch, const glm::dvec3& at,
                           std::span<const double> values) {
    const double up = std::clamp(glm::dot(patch.up, at - patch.origin), 0.0, 1.0);
    const double share = glm::dot(patch.along, at - patch.origin) / std::max(1 - up, 1e-6);
    const auto alongRow = [&](std::size_t number) {
        const PointRow& row = points.rows[patch.firstRow + number];
        const Between b = between(share, row.steps);
        return std::lerp(values[row.first + b.first], values[row.first + b.second], b.weight);
    };
    const Between rows = between(up, patch.steps);
    return std::lerp(alongRow(rows.first), alongRow(rows.second), rows.weight);
}

/// The patch of a surface that holds `at` and looks to the side of `normal`: the one that it is least far outside of.
inline std::size_t patchAt(const SurfacePoints& points, std::size_t surface, const glm::dvec3& at,
                           const glm::dvec3& normal) {
    const std::size_t begin = points.surfaces[surface].first;
    const std::size_t end =
        surface + 1 < points.surfaces.size() ? points.surfaces[surface + 1].first : points.patches.size();
    std::size_t best = begin;
    double least = 1e30;
    for (std::size_t i = begin; i < end; ++i) {
        const PointPatch& patch = points.patches[i];
        if (glm::dot(patch.normal, normal) < 0.9) continue;
        const double up = glm::dot(patch.up, at - patch.origin), along = glm::dot(patch.along, at - patch.origin);
        const double outside =
            std::max({0.0, -up, -along, up + along - 1}) + std::abs(glm::dot(patch.normal, at - patch.origin));
        if (outside >= least) continue;
        least = outside;
        best = i;
    }
    return best;
}

/// The share of a sun's irradiance that reaches a point with this normal where the directions in `blocked` are dark: the
/// mean over a grid of equal solid angles, weighted by the cosine.
inline double sunVisibility(const Sun& sun, const glm::dvec3& normal,
                            const std::function<bool(const glm::dvec3&)>& blocked) {
    constexpr int rings = 48, spokes = 96;
    const glm::dvec3 u = glm::normalize(std::abs(sun.direction.x) < 0.5 ? glm::cross(sun.direction, glm::dvec3(1, 0, 0))
                                                                        : glm::cross(sun.direction, glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(sun.direction, u);
    const double edge = std::cos(0.5 * glm::radians(sun.diameter));
    double light = 0, all = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double z = 1 - (1 - edge) * (ring + 0.5) / rings, r = std::sqrt(1 - z * z);
            const double turn = glm::two_pi<double>() * (spoke + 0.5) / spokes;
            const glm::dvec3 direction = z * sun.direction + r * (std::cos(turn) * u + std::sin(turn) * v);
            const double cosine = std::max(0.0, glm::dot(direction, normal));
            all += cosine;
            if (!blocked(direction)) light += cosine;
        }
    return light / all;
}

} // namespace shadowbench::models
