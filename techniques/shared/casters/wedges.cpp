#include "techniques/shared/casters/wedges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// How a triangle counts among a mesh's layers: as it is (1), turned over (−1), or not at all (0).
class Layers {
public:
    Layers(const EdgeMesh& mesh, const std::vector<bool>& facing) : facing_(facing), averted_(mesh.mesh().closed ? 0 : -1) {}

    [[nodiscard]] int of(std::uint32_t triangle) const {
        if (triangle == EdgeMesh::none) return 0;
        return facing_[triangle] ? 1 : averted_;
    }

private:
    const std::vector<bool>& facing_;
    int averted_;
};

/// Whether layers that do not end at an edge for the light's middle may do so for another of its points: unless both
/// triangles face all of the light, or none of it.
bool mayEnd(const EdgeMesh::Edge& edge, const std::vector<bool>& facing,
            const std::vector<std::vector<bool>>& facingCorners) {
    if (edge.right == EdgeMesh::none) return !facingCorners.empty();
    const bool whole = facing[edge.left];
    return std::any_of(facingCorners.begin(), facingCorners.end(), [&](const std::vector<bool>& corner) {
        return corner[edge.left] != whole || corner[edge.right] != whole;
    });
}

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { return glm::dot(a, glm::cross(b, c)); }

/// Whether the segment from the origin to `end` crosses a triangle.
bool crosses(const glm::dvec3& end, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double ab = determinant(end, a, b), bc = determinant(end, b, c), ca = determinant(end, c, a);
    const bool beside = std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0;
    const double along = ab + bc + ca; // end · normal
    if (beside || along == 0) return false;
    const double share = determinant(a, b, c) / along; // of the segment up to the triangle's plane
    return share > 0 && share < 1;
}

/// Moves the end of an edge that lies nearer than `nearest` along it to that depth.
glm::dvec3 cut(const WedgeLight& light, const glm::dvec3& end, const glm::dvec3& other, double nearest) {
    const double depth = light.depth(end);
    if (depth >= nearest) return end;
    return glm::mix(end, other, (nearest - depth) / (light.depth(other) - depth));
}

} // namespace

std::vector<LayerEdge> layerEdges(const EdgeMesh& mesh, const std::vector<bool>& facing) {
    return layerEdges(mesh, facing, {});
}

std::vector<LayerEdge> layerEdges(const EdgeMesh& mesh, const std::vector<bool>& facing,
                                  const std::vector<std::vector<bool>>& facingCorners) {
    const Layers layers(mesh, facing);
    std::vector<LayerEdge> result;
    for (const EdgeMesh::Edge& edge : mesh.edges()) {
        const int change = layers.of(edge.left) - layers.of(edge.right);
        if (change == 0 && !mayEnd(edge, facing, facingCorners)) continue;
        if (change < 0)
            result.push_back({edge.to, edge.from, edge.right, edge.left, -change});
        else
            result.push_back({edge.from, edge.to, edge.left, edge.right, change});
    }
    return result;
}

int layersBetween(const EdgeMesh& mesh, const std::vector<bool>& facing, const glm::dvec3& point, const glm::dvec3& light) {
    const Layers layers(mesh, facing);
    const Mesh& source = mesh.mesh();
    const auto corner = [&](std::uint32_t vertex) { return glm::dvec3(source.positions[vertex]) - point; };
    int count = 0;
    for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
        const glm::uvec3& i = source.triangles[t];
        if (layers.of(t) != 0 && crosses(light - point, corner(i.x), corner(i.y), corner(i.z))) ++count;
    }
    return count;
}

WedgeLight::WedgeLight(const Light& light, int side)
    : centre(light.centre), halfU(0.5 * light.u), halfV(0.5 * light.v),
      axis(static_cast<double>(side) * glm::normalize(glm::cross(light.u, light.v))) {}

double WedgeLight::depth(const glm::dvec3& point) const { return glm::dot(point - centre, axis); }

std::optional<Wedge> wedgeOver(const WedgeLight& light, const glm::dvec3& from, const glm::dvec3& to, double nearest,
                               double far) {
    const double shallow = std::min(light.depth(from), light.depth(to));
    if (std::max(light.depth(from), light.depth(to)) <= nearest || shallow >= far) return std::nullopt;
    constexpr double thicker = 1e-4; // of the edge's depth
    const double depth = (1 - thicker) * std::max(shallow, nearest);
    const auto moved = [&](const glm::dvec3& end) {
        return light.centre + (end - light.centre) * (depth / light.depth(end));
    };
    const glm::dvec3 a = moved(cut(light, from, to, nearest)), b = moved(cut(light, to, from, nearest));

    // The light as projected through a and through b: two equal parallelograms, of which the hexagon is the hull.
    const auto farther = [&](const glm::dvec3& end) { return light.centre + (end - light.centre) * (far / depth); };
    const glm::dvec3 farA = farther(a), farB = farther(b);
    const double size = (far - depth) / depth;
    const auto along = [&](const glm::dvec3& half) { return glm::dot(half, farB - farA) < 0 ? -size * half : size * half; };
    glm::dvec3 f = along(light.halfU), g = along(light.halfV);
    if (determinant(f, g, light.axis) < 0) std::swap(f, g);
    return Wedge{a, b, farA - f - g, farA + f - g, farB + f - g, farB + f + g, farB - f + g, farA - f + g};
}

} // namespace shadowbench::techniques
