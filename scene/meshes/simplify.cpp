#include "scene/mesh_faults.h"
#include "scene/meshes/foreign_mesh.h"
#include "scene/meshes/import.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <meshoptimizer.h>

namespace shadowbench {

Mesh withoutFlat(const Mesh& mesh) {
    if (mesh.closed) return mesh;
    Mesh result{mesh.positions, {}, mesh.closed};
    std::ranges::copy_if(mesh.triangles, std::back_inserter(result.triangles),
                         [&](const glm::uvec3& t) { return hasArea(mesh, t); });
    if (result.triangles.empty() || result.triangles.size() == mesh.triangles.size()) return mesh;
    result.flat = faultsOf(mesh).flat;
    return compacted(result);
}

Mesh simplified(const Mesh& mesh, int triangles) {
    if (mesh.triangles.size() <= static_cast<std::size_t>(triangles)) return mesh;
    std::vector<unsigned> indices;
    for (const glm::uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    std::vector<unsigned> kept(indices.size());
    constexpr float kAnyError = std::numeric_limits<float>::max(); // the count decides, not the error
    kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(glm::vec3), 3 * static_cast<std::size_t>(triangles), kAnyError, 0, nullptr));
    Mesh result{mesh.positions, {}, mesh.closed, mesh.flat};
    for (std::size_t i = 0; i + 2 < kept.size(); i += 3) result.triangles.emplace_back(kept[i], kept[i + 1], kept[i + 2]);
    return compacted(result);
}

} // namespace shadowbench
