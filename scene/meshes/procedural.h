// Procedural models whose detail is one number, so that a LOD chain is one generator called several times.
#pragma once

#include "scene/mesh.h"

#include <cstdint>

namespace shadowbench {

/// Tower and cap of a windmill standing on y = 0 (its foot reaches 5 cm below), about 4 m high with its rotor, which belongs
/// at (0, 2.9, 0.72). Within 5 % of `triangles` from 30 up; fewer make 30. Closed.
Mesh windmillTower(int triangles);

/// Its rotor: hub and four lattice vanes around the z axis, 1.67 m in radius, centred on the origin. Within 3 % of
/// `triangles` from 54 up; fewer make 54. Closed.
Mesh windmillRotor(int triangles);

/// A tree standing on y = 0 (its trunk reaches 5 cm below), about 3 m high and 2 m wide: trunk, branches and closed leaves.
/// Within 2 % of `triangles` from 50 up. Closed. The crown keeps its shape and its leaves' total area over levels: fewer
/// triangles means fewer, larger leaves, and no branches below 256.
Mesh tree(int triangles, std::uint32_t seed);

/// The leaves on `count` cards with sides of `size` < 1 in a ball of radius 1 around the origin, turned outwards at random:
/// of each card what an alpha test at `cutoff` leaves of one picture of a spray of leaves with `texels`² texels, whose alpha
/// falls from 1 in the middle of a leaf to ½ at its border (cutByMask()). Open, with its cards.
Mesh leafCards(int count, double size, int texels, double cutoff, std::uint32_t seed);

} // namespace shadowbench
