// What the techniques share that project a shadow map's texels back onto the light (shared/filters/back_projection.glsl).
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/min_max_pyramid.h"

namespace shadowbench::techniques {

/// `flat`: how uneven a square of texels may be that is projected as one.
Parameter flatParameter();

/// The frame's receivers, the light as they see it in `view`, and the map's pyramid. A rectangle's sides are taken to be at
/// right angles to each other. `followPlane`: texels beside the receiver are compared with its plane, not with its depth.
void setBackProjection(gl::Program& program, const Frame& frame, const LightView& view, const MinMaxPyramid& pyramid,
                       bool followPlane);

/// Mean over the frame's pixels that see something of what `program` writes.
double meanOverReceivers(const Frame& frame, const gl::Program& program);

} // namespace shadowbench::techniques
