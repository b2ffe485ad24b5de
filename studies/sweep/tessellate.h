// The same surface in smaller triangles.
#pragma once

#include "scene/mesh.h"

namespace shadowbench {

/// Every triangle cut into four at the middles of its sides, `times` times over. Triangles that share a side share its
/// middle, so a closed mesh stays closed. Middles are rounded to float: a face that lies askew bends by half a unit in the
/// last place.
Mesh quartered(const Mesh& mesh, int times);

} // namespace shadowbench
