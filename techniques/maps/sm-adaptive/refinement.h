// Refinement of a quadtree over a light's image planes by what pixels need (fitted virtual shadow maps; no GL).
#pragma once

#include "techniques/shared/maps/tile_choice.h"

#include <vector>

namespace shadowbench::techniques {

/// A node of the quadtree over a plane: level 0 is the whole plane, level l one of 2^l × 2^l squares, `at` its column and
/// row.
struct Page {
    int plane = 0;
    int level = 0;
    glm::ivec2 at{0};
    friend bool operator==(const Page&, const Page&) = default;
};

struct Refinement {
    int texels = 128;   // per side of a page: a plane all of level l is a map of (texels · 2^l)²
    int levels = 8;     // the finest level
    int pages = 1024;   // at most
    double density = 1; // texels that must lie along a pixel
};

/// The leaves that the demands need, each with some demand in it. A page is cut in four, of which those without a demand are
/// dropped, as long as one of its pixels is shorter than a texel / density along x or y. Pages with the largest sum of what
/// their texels are too long, in pixels, are cut first; one whose parts would exceed `pages` stays. There may be more than
/// `pages` only if there are more planes with a demand.
std::vector<Page> refine(std::vector<Demand> demands, const Refinement& limits);

} // namespace shadowbench::techniques
