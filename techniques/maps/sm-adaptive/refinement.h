// Refinement of a quadtree over a light's image planes by what pixels need (fitted virtual shadow maps; no GL).
#pragma once

#include "techniques/shared/maps/page.h"
#include "techniques/shared/maps/tile_choice.h"

#include <vector>

namespace shadowbench::techniques {

/// Level 0 of the quadtree is the whole plane, level l is 2^l × 2^l squares.
inline constexpr int finestLevel = 8;

struct Refinement {
    int texels = 128;         // per side of a page: a plane all of level l is a map of (texels · 2^l)²
    int levels = finestLevel; // the finest level, at most `finestLevel`
    int pages = 1024;         // at most
    double density = 1;       // texels that must lie along a pixel
    double share = 1;         // of a page's pixels for which they must, in [0, 1]
};

/// The leaves that the demands need, each with some demand in it. A page is cut in four, of which those without a demand are
/// dropped, as long as more than 1 − share of its pixels are shorter than a texel / density along x or y. Pages with the
/// largest sum of what their texels are too long, in pixels, are cut first; one whose parts would exceed `pages` stays.
/// There may be more than `pages` only if there are more planes with a demand.
std::vector<Page> refine(const std::vector<Demand>& demands, const Refinement& limits);

} // namespace shadowbench::techniques
