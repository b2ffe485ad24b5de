// Triangles and the texture whose alpha cuts holes into them, as engines draw foliage and fences: with an alpha test. What
// it leaves of them as triangles: scene/meshes/alpha_mask.h.
#pragma once

#include "base/image.h"
#include "scene/mesh.h"

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace shadowbench {

/// A texture's alpha, and from which value on it is solid.
struct AlphaMask {
    enum class Wrap { Repeat, Mirror, Clamp };

    Image<float> alpha; // row 0 at v = 0, as in glTF
    double cutoff = 0.5;
    bool nearest = false; // texels are squares; otherwise alpha is linear between neighbouring centres
    Wrap u = Wrap::Repeat, v = Wrap::Repeat;
};

struct MaskedMesh {
    Mesh mesh;
    std::vector<glm::vec2> uv;             // of each position
    std::shared_ptr<const AlphaMask> mask; // several meshes may have one
};

} // namespace shadowbench
