// How many passes make a shadow width map, and how far each of them reaches. No GL.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::techniques {

struct WidthPasses {
    std::vector<glm::ivec2> steps; // of each pass: texels along x and y by which it shrinks the occluders, 0 or 1
    double reachPerPass = 0;       // in the units of texelReach (shared/filters/nearest_texel.h)
};

/// Passes that together reach at least `widest` along both axes of a map whose texels are `texelReach` apart, but no more
/// than `most`. A pass goes as far along either axis, as penumbrae are wide there, so that its box has the light's
/// proportions.
WidthPasses widthPasses(const glm::dvec2& texelReach, double widest, int most);

} // namespace shadowbench::techniques
