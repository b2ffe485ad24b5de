#include "techniques/shared/casters/volume_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A body's extent along an axis.
std::pair<double, double> extent(const ConvexBody& body, const glm::dvec3& axis) {
    constexpr double rounding = 1e-12; // of a direction that runs along the plane at right angles to the axis
    double low = infinity, high = -infinity;
    for (const glm::dvec3& point : body.points) {
        const double at = glm::dot(axis, point);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    for (const glm::dvec3& direction : body.directions) {
        const double slope = glm::dot(axis, direction), none = rounding * glm::length(direction);
        if (slope < -none) low = -infinity;
        if (slope > none) high = infinity;
    }
    return {low, high};
}

double largestCoordinate(const ConvexBody& body) {
    double largest = 0;
    for (const glm::dvec3& point : body.points)
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(point[axis]));
    return largest;
}

/// Corners of `Bounds::corners` at the ends of the box's edges: those that differ in one coordinate.
std::vector<std::pair<std::size_t, std::size_t>> edgesOf(const std::array<glm::dvec3, 8>& corners) {
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t a = 0; a < corners.size(); ++a)
        for (std::size_t axis = 1; axis < corners.size(); axis *= 2)
            if ((a & axis) == 0) edges.emplace_back(a, a | axis);
    return edges;
}

} // namespace

ViewPyramid::ViewPyramid(const Camera& camera, double aspect, double depth) {
    const auto [right, up, forward] = camera.basis();
    const double tangent = std::tan(0.5 * glm::radians(camera.fovy));
    std::array<glm::dvec3, 4> rays;
    for (std::size_t corner = 0; corner < rays.size(); ++corner) {
        const double x = corner == 0 || corner == 3 ? -1 : 1, y = corner < 2 ? -1 : 1;
        rays[corner] = forward + x * tangent * aspect * right + y * tangent * up;
    }
    body_.points = {camera.eye};
    for (std::size_t corner = 0; corner < rays.size(); ++corner) {
        if (std::isinf(depth))
            body_.directions.push_back(rays[corner]);
        else
            body_.points.push_back(camera.eye + depth * rays[corner]);
        normals_[corner] = glm::normalize(glm::cross(rays[corner], rays[(corner + 1) % rays.size()]));
    }
    normals_.back() = forward;
}

VolumeBounds::VolumeBounds(const Bounds& box, const glm::dmat4& world, std::span<const glm::dvec4> lights) {
    const std::array<glm::dvec3, 8> corners = box.corners();
    for (const glm::dvec3& corner : corners) body_.points.emplace_back(world * glm::dvec4(corner, 1));
    const auto addNormal = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 normal = glm::cross(a, b);
        const double length = glm::length(normal);
        if (length > 0) normals_.push_back(normal / length);
    };
    for (int axis = 0; axis < 3; ++axis) addNormal(glm::dvec3(world[axis]), glm::dvec3(world[(axis + 1) % 3]));
    for (const glm::dvec4& light : lights)
        for (const glm::dvec3& point : body_.points) body_.directions.push_back(point * light.w - glm::dvec3(light));
    for (std::size_t light = 0; light < lights.size(); ++light)
        for (const auto& [from, to] : edgesOf(corners))
            addNormal(body_.points[to] - body_.points[from], body_.directions[light * corners.size() + from]);
}

/// By planes between the two bodies that are parallel to a face of either.
bool VolumeBounds::mayMeet(const ViewPyramid& pyramid) const {
    // Well above the rounding of 32-bit positions, which is 6·10⁻⁸ of a coordinate a step.
    const double apart = 1e-5 * std::max(largestCoordinate(body_), largestCoordinate(pyramid.body()));
    const auto separates = [&](const glm::dvec3& axis) {
        const auto [low, high] = extent(body_, axis);
        const auto [seenLow, seenHigh] = extent(pyramid.body(), axis);
        return low > seenHigh + apart || high < seenLow - apart;
    };
    return std::ranges::none_of(pyramid.normals(), separates) && std::ranges::none_of(normals_, separates);
}

} // namespace shadowbench::techniques
