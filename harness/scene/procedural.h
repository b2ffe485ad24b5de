// Procedural models whose detail is one number, so that a LOD chain is one generator called several times.
#pragma once

#include "harness/scene/mesh.h"

#include <cstdint>

namespace shadowbench {

/// Tower and cap of a windmill standing on y = 0, about 4 m high, about `triangles` triangles. Closed.
Mesh windmillTower(int triangles);

/// Its rotor: hub and four lattice vanes around the z axis, centred on the origin, about `triangles` triangles. Closed.
Mesh windmillRotor(int triangles);

/// A tree standing on y = 0, about 3 m high: trunk, branches and closed leaves, about `triangles` triangles. Closed. The crown keeps
/// its shape and projected area over levels: fewer triangles means fewer, larger leaves.
Mesh tree(int triangles, std::uint32_t seed);

}  // namespace shadowbench
