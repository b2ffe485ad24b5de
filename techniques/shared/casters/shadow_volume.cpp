#include "techniques/shared/casters/shadow_volume.h"

#include <glm/geometric.hpp>
#include <unordered_map>

namespace shadowbench::techniques {

EdgeMesh::EdgeMesh(const Mesh& mesh) : mesh_(&mesh), bounds_(mesh.bounds()) {
    // A directed edge waits here until the triangle on its other side brings the opposite one.
    std::unordered_map<std::uint64_t, std::uint32_t> open;
    const auto key = [](std::uint32_t a, std::uint32_t b) { return (static_cast<std::uint64_t>(a) << 32) | b; };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3& triangle = mesh.triangles[t];
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = triangle[corner];
            const std::uint32_t b = triangle[(corner + 1) % 3];
            const auto opposite = open.find(key(b, a));
            if (opposite == open.end()) {
                open[key(a, b)] = static_cast<std::uint32_t>(edges_.size());
                edges_.push_back({a, b, t, none});
            } else {
                edges_[opposite->second].right = t;
                open.erase(opposite);
            }
        }
    }
}

std::vector<bool> EdgeMesh::facing(const glm::dvec4& light) const {
    std::vector<bool> result(mesh_->triangles.size());
    for (std::size_t t = 0; t < result.size(); ++t) {
        const glm::uvec3& i = mesh_->triangles[t];
        const glm::dvec3 a(mesh_->positions[i.x]), b(mesh_->positions[i.y]), c(mesh_->positions[i.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        result[t] = glm::dot(normal, glm::dvec3(light) - a * light.w) > 0;
    }
    return result;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> silhouette(const EdgeMesh& mesh, const std::vector<bool>& facing) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const EdgeMesh::Edge& edge : mesh.edges()) {
        const bool left = facing[edge.left];
        const bool right = edge.right != EdgeMesh::none && facing[edge.right];
        if (left && !right) result.emplace_back(edge.from, edge.to);
        if (right && !left) result.emplace_back(edge.to, edge.from);
    }
    return result;
}

namespace {

void appendCaps(const EdgeMesh& mesh, const std::vector<bool>& facing, bool atInfinity,
                std::vector<std::uint32_t>& indices) {
    const auto vertexCount = static_cast<std::uint32_t>(mesh.mesh().positions.size());
    for (std::size_t t = 0; t < facing.size(); ++t) {
        if (!facing[t] && !atInfinity) continue;
        const std::uint32_t far = facing[t] ? 0 : vertexCount;
        const glm::uvec3& i = mesh.mesh().triangles[t];
        indices.insert(indices.end(), {i.x + far, i.y + far, i.z + far});
    }
}

} // namespace

std::size_t appendShadowVolume(const EdgeMesh& mesh, const glm::dvec4& light, Caps caps,
                               std::vector<std::uint32_t>& indices) {
    const std::vector<bool> facing = mesh.facing(light);
    const auto vertexCount = static_cast<std::uint32_t>(mesh.mesh().positions.size());
    const bool endsInPoint = light.w == 0;
    const std::size_t before = indices.size();
    if (caps != Caps::None) appendCaps(mesh, facing, caps == Caps::Both && !endsInPoint, indices);
    const std::size_t capIndices = indices.size() - before;
    for (const auto& [a, b] : silhouette(mesh, facing)) {
        indices.insert(indices.end(), {b, a, a + vertexCount});
        if (!endsInPoint) indices.insert(indices.end(), {b, a + vertexCount, b + vertexCount});
    }
    return capIndices;
}

glm::dmat4 infiniteProjection(const glm::dmat4& projection, double near) {
    glm::dmat4 result = projection;
    result[2][2] = -1;
    result[3][2] = -2 * near;
    return result;
}

} // namespace shadowbench::techniques
