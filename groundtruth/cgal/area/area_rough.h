// What certainly hides nothing of a light, in plain double precision.
#pragma once

#include "groundtruth/cgal/area/area_light_map.h"
#include "groundtruth/cgal/area/area_shape.h"
#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/shaft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::area {

/// Approximate homogeneous light coordinates with a bound of their error: culls what certainly hides nothing.
class RoughMap {
public:
    RoughMap(const ReceiverPoint& point, const Light& light, int sense, double reach)
        : map_(vector<double>(point.rounded()), vector<double>(glm::dvec3(0)), light, sense),
          window_(lightWindow(light.kind)) {
        const auto size = [](const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
        // Every product below is of one component of u or v, and two more of at most `far`: the roundings of all, some 40 of
        // 2⁻⁵³ each, and the point's own error stay below this.
        const double far = reach + size(light.centre) + size(point.rounded()) + size(light.u) + size(light.v);
        const double sides = size(light.u) + size(light.v);
        const double pointError = size(point.high() - point.low());
        error_ = sides * far * (0x1p-45 * far + 8 * pointError);
    }

    [[nodiscard]] Vector<double> operator()(const glm::dvec3& world) const { return map_(world); }
    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] double distance() const { return map_.distance; }
    [[nodiscard]] double window() const { return window_; }

    /// The pyramid from the point to the window; for a line light the flat triangle.
    [[nodiscard]] Shaft shaft(bool flat) const {
        const glm::dvec3 x = plain(map_.rowX), y = plain(map_.rowY), w = plain(map_.rowW);
        const double rows = flat ? 0 : window_;
        Shaft result;
        for (const glm::dvec3& normal : {window_ * w + x, window_ * w - x, rows * w + y, rows * w - y, w})
            result.add({normal, -glm::dot(normal, plain(map_.head)), error_});
        result.add({-w, glm::dot(w, plain(map_.head)) + map_.distance, error_});
        return result;
    }

    /// Whether the triangle certainly misses the pyramid.
    [[nodiscard]] bool misses(const std::array<Vector<double>, 3>& t, bool flat) const {
        const double rows = flat ? 0 : window_;
        const auto allBelow = [&](auto&& value) { return std::max({value(t[0]), value(t[1]), value(t[2])}) < -error_; };
        return allBelow([&](const auto& p) { return window_ * p.z + p.x; }) ||
               allBelow([&](const auto& p) { return window_ * p.z - p.x; }) ||
               allBelow([&](const auto& p) { return rows * p.z + p.y; }) ||
               allBelow([&](const auto& p) { return rows * p.z - p.y; }) || allBelow([](const auto& p) { return p.z; }) ||
               allBelow([&](const auto& p) { return map_.distance - p.z; });
    }

    /// Whether the triangle certainly lies strictly between the point and the light's plane.
    [[nodiscard]] bool between(const std::array<Vector<double>, 3>& t) const {
        return std::ranges::all_of(t, [&](const auto& p) { return p.z > error_ && p.z < map_.distance - error_; });
    }

private:
    static glm::dvec3 plain(const Vector<double>& v) { return {v.x, v.y, v.z}; }

    LightMap<double> map_;
    double window_;
    double error_;
};

} // namespace shadowbench::groundtruth::area
