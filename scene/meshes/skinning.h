// Linear blend skinning: a mesh whose vertices follow bones.
#pragma once

#include "scene/mesh.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

namespace shadowbench {

/// The bones that a vertex follows, and their shares, which sum to 1.
struct BoneWeights {
    std::array<int, 2> bones{0, 0};
    std::array<double, 2> weights{1, 0};
};

/// A mesh at rest, with the weights of each position.
struct SkinnedMesh {
    Mesh mesh;
    std::vector<BoneWeights> weights;
};

/// The mesh in a pose: each position is the mean, by its weights, of where its bones take it. `bones`: affine maps from the
/// mesh at rest.
Mesh posed(const SkinnedMesh& skinned, std::span<const glm::dmat4> bones);

} // namespace shadowbench
