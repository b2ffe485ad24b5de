#include "scene/meshes/skinning.h"

namespace shadowbench {

Mesh posed(const SkinnedMesh& skinned, std::span<const glm::dmat4> bones) {
    Mesh mesh = skinned.mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec4 rest(glm::dvec3(mesh.positions[i]), 1);
        const BoneWeights& of = skinned.weights[i];
        glm::dvec4 position(0);
        for (std::size_t k = 0; k < of.bones.size(); ++k)
            position += of.weights[k] * (bones[static_cast<std::size_t>(of.bones[k])] * rest);
        mesh.positions[i] = glm::vec3(position);
    }
    return mesh;
}

} // namespace shadowbench
