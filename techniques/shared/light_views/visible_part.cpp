#include "techniques/shared/light_views/visible_part.h"

#include "techniques/shared/light_views/fitting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::techniques {
namespace {

using Polygon = std::vector<glm::dvec3>;

/// Sorts points of one plane around their middle, so that they bound a convex polygon.
void sortAround(Polygon& polygon, const glm::dvec3& normal) {
    const glm::dvec3 least = std::abs(normal.x) < std::abs(normal.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(normal, least));
    const glm::dvec3 y = glm::cross(glm::normalize(normal), x);
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : polygon) middle += p / static_cast<double>(polygon.size());
    const auto angle = [&](const glm::dvec3& p) { return std::atan2(glm::dot(p - middle, y), glm::dot(p - middle, x)); };
    std::sort(polygon.begin(), polygon.end(), [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
}

/// The convex body bounded by `faces` without what lies behind `plane`; the cut becomes a face.
std::vector<Polygon> cutBody(const std::vector<Polygon>& faces, const glm::dvec4& plane) {
    std::vector<Polygon> kept;
    Polygon lid;
    for (const Polygon& face : faces) {
        Polygon rest = cut(face, plane, &lid);
        if (rest.size() >= 3) kept.push_back(std::move(rest));
    }
    if (lid.size() < 3) return kept;
    sortAround(lid, glm::dvec3(plane));
    kept.push_back(std::move(lid));
    return kept;
}

std::vector<Polygon> boxFaces(const Bounds& box) {
    const auto c = box.corners(); // corner i takes high.x, high.y, high.z where bit 0, 1, 2 of i is set
    constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    std::vector<Polygon> result;
    for (const auto& face : faces) result.push_back({c[face[0]], c[face[1]], c[face[2]], c[face[3]]});
    return result;
}

} // namespace

std::array<glm::dvec4, 6> frustumPlanes(const glm::dmat4& clipFromWorld) {
    const glm::dmat4 m = glm::transpose(clipFromWorld);
    return {m[3] + m[0], m[3] - m[0], m[3] + m[1], m[3] - m[1], m[3] + m[2], m[3] - m[2]};
}

std::vector<glm::dvec3> visiblePart(const Bounds& box, const Camera& camera, double aspect,
                                    std::span<const glm::dvec4> halfSpaces) {
    std::vector<Polygon> faces = boxFaces(box);
    for (const glm::dvec4& plane : frustumPlanes(camera.projection(aspect) * camera.view())) faces = cutBody(faces, plane);
    for (const glm::dvec4& plane : halfSpaces) faces = cutBody(faces, plane);
    std::vector<glm::dvec3> points;
    for (const Polygon& face : faces) points.insert(points.end(), face.begin(), face.end());
    return points;
}

} // namespace shadowbench::techniques
