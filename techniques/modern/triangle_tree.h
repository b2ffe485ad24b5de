// A tree of boxes over all triangles of a snapshot, laid out for shaders (techniques/modern/triangle_tree.glsl): nodes in
// depth-first order, each with the number of the one that follows all below it, so that a ray walks the tree without a
// stack.
#pragma once

#include "scene/snapshot.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowbench::techniques {

/// Two texels of four numbers (gl/texture.h, BufferTexture).
struct TreeNode {
    glm::vec3 low;
    std::uint32_t after; // the node to go on with where the ray does not meet this one's box
    glm::vec3 high;
    std::uint32_t triangle; // of a leaf, from 1; 0 of the others
};

struct TriangleTree {
    std::vector<TreeNode> nodes;
    std::vector<glm::vec4> corners; // three a triangle, in world space
};

/// Boxes are cut in two where rays meet the fewest triangles by the surface area heuristic, with the middles of triangles in
/// slices (Wald 2007).
TriangleTree treeOver(const Snapshot& snapshot);

} // namespace shadowbench::techniques
