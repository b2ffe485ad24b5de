// Normal offset shadows (Holbert, "Saying Goodbye to Shadow Acne", GDC 2011): before a receiver is tested it is moved along
// its normal, by the texel's size in the world times the sine of the angle between normal and light. Departures: the texel's
// size is half its extent in the direction in which the plane falls off, which is what suffices on a plane, where the poster
// leaves a scale to be tuned; and a warped map's depths change over a plane that faces the light, too, which is covered as
// well (docs/techniques.md, "Bias").
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/shared/maps/depth_map.h"

#include <glm/vec2.hpp>

namespace shadowbench::techniques {

/// For programs over shared/maps/tested_point.glsl: none if receivers stay where they are.
gl::Defines normalOffsetDefines(Bias bias);

/// The uniforms of such a program that was made with `normalOffsetDefines`, for a map of `size` texels; beside them it needs
/// those of shared/maps/light_space.glsl.
void setNormalOffset(gl::Program& program, const Frame& frame, Bias bias, glm::ivec2 size);

} // namespace shadowbench::techniques
