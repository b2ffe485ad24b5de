#include "scene/meshes/primitives.h"

#include "scene/meshes/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

/// The icosahedron's corners and its faces, counter-clockwise from outside.
std::array<glm::dvec3, 12> icosahedronCorners() {
    const double t = glm::golden_ratio<double>();
    return {glm::dvec3{-1, t, 0}, {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
            {0, -1, -t},          {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
}

constexpr std::array<std::array<unsigned, 3>, 20> kIcosahedronFaces{
    {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
     {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

/// Unit direction of a face's grid point. The corners are summed in the order of their index, so that the two faces at an
/// edge get the very same number there and `weld` joins them.
glm::dvec3 direction(const std::array<glm::dvec3, 12>& corners, const std::array<unsigned, 3>& face,
                     const glm::ivec3& weight) {
    std::array<std::pair<unsigned, int>, 3> terms{{{face[0], weight.x}, {face[1], weight.y}, {face[2], weight.z}}};
    std::sort(terms.begin(), terms.end());
    glm::dvec3 sum(0);
    for (const auto& [corner, share] : terms) sum += static_cast<double>(share) * corners[corner];
    return glm::normalize(sum);
}

/// Unit sphere: each face of the icosahedron cut into n² triangles.
Mesh geodesic(int n) {
    const auto corners = icosahedronCorners();
    Mesh mesh;
    for (const auto& face : kIcosahedronFaces) {
        const auto point = [&](int i, int j) {
            mesh.positions.push_back(glm::vec3(direction(corners, face, {n - i - j, i, j})));
            return static_cast<std::uint32_t>(mesh.positions.size() - 1);
        };
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i + j < n; ++i) {
                mesh.triangles.emplace_back(point(i, j), point(i + 1, j), point(i, j + 1));
                if (i + j + 1 < n) mesh.triangles.emplace_back(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
            }
        }
    }
    mesh.closed = true;
    return weld(mesh);
}

int geodesicFrequency(int triangles) { return std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 20.0)))); }

} // namespace

Mesh plane(double half) {
    const auto h = static_cast<float>(half);
    return {{{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}}, {{0, 1, 2}, {0, 2, 3}}, false};
}

Mesh box(const glm::dvec3& size) {
    const glm::vec3 h(0.5 * size);
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1U ? h.x : -h.x, i & 2U ? h.y : -h.y, i & 4U ? h.z : -h.z);
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    mesh.closed = true;
    return mesh;
}

Mesh sphere(double radius, int triangles) {
    Mesh mesh = geodesic(geodesicFrequency(triangles));
    for (glm::vec3& position : mesh.positions) position = glm::vec3(radius * glm::normalize(glm::dvec3(position)));
    return mesh;
}

Mesh column(double radius, double height, int sides) { return rod({0, 0, 0}, {0, height, 0}, radius, radius, sides); }

} // namespace shadowbench
