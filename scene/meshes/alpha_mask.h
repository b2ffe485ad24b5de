// Holes of a texture as holes of the mesh: what an alpha test leaves of triangles, as triangles. So every oracle, technique
// and exported file has the same outline, whether it knows textures or not.
#pragma once

#include "scene/masked_mesh.h"

namespace shadowbench {

/// The parts of the triangles whose alpha is not below the cutoff, as the largest level of the texture has it: of squares
/// exactly; between texels' centres the outline is straight from one grid line to the next, on which it is exact (marching
/// squares, by the value at the saddle where two ways are open). A triangle without an area in the texture is kept or left
/// out as a whole. Throws BadInput where a triangle covers more of the texture than Limit::Triangles texels, or the parts
/// are more than that.
Mesh cutByMask(const MaskedMesh& cards);

} // namespace shadowbench
