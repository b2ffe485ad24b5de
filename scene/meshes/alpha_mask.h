// Holes of a texture as holes of the mesh: what an alpha test leaves of triangles, as triangles. So every oracle, technique
// and exported file has the same outline, whether it knows textures or not.
#pragma once

#include "base/image.h"
#include "scene/mesh.h"

#include <glm/vec2.hpp>
#include <span>

namespace shadowbench {

/// A texture's alpha, and from which value on it is solid.
struct AlphaMask {
    enum class Wrap { Repeat, Mirror, Clamp };

    Image<float> alpha; // row 0 at v = 0, as in glTF
    double cutoff = 0.5;
    bool nearest = false; // texels are squares; otherwise alpha is linear between neighbouring centres
    Wrap u = Wrap::Repeat, v = Wrap::Repeat;
};

/// The parts of the triangles whose alpha is not below the cutoff, as the largest level of the texture has it: of squares
/// exactly; between texels' centres the outline is straight from one grid line to the next, on which it is exact (marching
/// squares, by the value at the saddle where two ways are open). `uv`: of each position. A triangle without an area in the
/// texture is kept or left out as a whole. Throws BadInput where a triangle covers more of the texture than
/// Limit::Triangles texels, or the parts are more than that.
Mesh cutByMask(const Mesh& mesh, std::span<const glm::vec2> uv, const AlphaMask& mask);

} // namespace shadowbench
