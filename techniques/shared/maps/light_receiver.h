// The uniforms of shared/maps/light_receiver.glsl, set in one place.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"

namespace shadowbench::techniques {

/// `followPlane`: texels beside the receiver's own are compared with the receiver's plane instead of its depth.
void setLightReceiver(gl::Program& program, const LightView& view, bool followPlane);

} // namespace shadowbench::techniques
