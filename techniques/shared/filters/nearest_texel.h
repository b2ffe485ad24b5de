// The uniforms of shared/filters/nearest_texel.glsl, set in one place.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"

#include <glm/vec2.hpp>

namespace shadowbench::techniques {

/// Greatest radius of a search, in texels: llvmpipe ends a shader's loops after 65,535 rounds, and it visits every texel of
/// a square.
inline constexpr int widestSearch = 127;

/// How far apart neighbouring texels of a map of `side` texels are along x and y, as penumbrae are wide there: an edge at
/// depth b whose shadow falls on a receiver at depth r has a penumbra that reaches 1/b − 1/r (1/m) to each side. Over a
/// light of greater width and height than 0.
glm::dvec2 texelReach(const Light& light, const LightView& view, int side);

/// Sets `shared/maps/light_receiver.glsl` too. `radius`: of the search, in texels, at most widestSearch.
void setNearestTexel(gl::Program& program, const Light& light, const LightView& view, int side, int radius,
                     bool followPlane);

} // namespace shadowbench::techniques
