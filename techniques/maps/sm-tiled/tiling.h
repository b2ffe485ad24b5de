// A texture cut in two again and again, each half for a part of a light's image planes (no GL).
#pragma once

#include "techniques/shared/maps/tile_choice.h"

#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Tiles that share out an atlas of side² texels: at most `tiles`, or one for each of the `planes` that has a demand. All
/// demands lie in some tile. The error that is expected of a tile is the length of its texels in pixels, summed over its
/// demands. The tile whose best cut saves most of it is cut first: at the cell border, and into shares of its texels, that
/// leave the least; each part is then narrowed to the cells with demands.
std::vector<PlaneTile> tilesFor(std::span<const Demand> demands, int planes, int cells, int side, int tiles);

} // namespace shadowbench::techniques
