// Visibility as a picture of the scene that it belongs to: its objects' colours under its light. Nothing is scored by it.
#pragma once

#include "harness/cells/scene_frames.h"

namespace shadowbench {

/// The light that a frame has at each pixel, linear: `ambient` is there without the scene's light, which adds `direct` times
/// as much where V is 1. Background is dark, and has no direct light.
struct PictureShading {
    Image<glm::vec3> ambient;
    Image<float> direct;
};

/// Of the scored frame, which is shown then. As the pictures that `flip` compares (metrics::shading); under an environment V
/// is a share of the irradiance that a surface would get unshadowed, so that `direct` is this irradiance, as a share of the
/// largest that is seen.
PictureShading pictureShading(SceneFrames& frames);

/// The same of what a G-buffer holds.
PictureShading pictureShading(const Snapshot& snapshot, const metrics::Drawn& drawn, const Image<glm::vec3>& normals);

/// The picture with visibility `v`, of the same size, for a screen (sRGB).
Image<glm::vec3> shadedPicture(const PictureShading& shading, const Image<float>& v);

} // namespace shadowbench
