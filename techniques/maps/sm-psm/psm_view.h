// Fitting of perspective shadow maps (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

namespace shadowbench::techniques {

/// What is done about casters behind the eye, which the perspective map sends beyond infinity (course, "Shadows From the
/// Back"): nothing; the virtual camera is moved back until nothing is behind it; or they are kept where the homogeneous
/// projection puts them, before the light's near plane (Kozlov's negative near plane).
enum class BehindEye { Lost, MoveBack, NegativeNear };

/// What the map holds of post-perspective space: all of its unit cube, or what the scene's bounding box fills of it (course,
/// "Deep Light Sources").
enum class PsmBody { Cube, Box };

struct PsmOptions {
    double shift = 0; // metres that the virtual camera stands behind the camera, its near plane left where it was
    BehindEye behindEye = BehindEye::NegativeNear;
    PsmBody body = PsmBody::Box;
};

/// The camera moved back by `shift`, its field of view narrowed so that it just holds the old frustum; near and far plane
/// stay where they are (course, "Near/Far Selection", Kozlov 2004).
Camera movedBack(const Camera& camera, double shift);

/// The camera whose perspective the map's space comes after: `camera` moved back as the options say, its far plane where the
/// visible part of the scene ends.
Camera virtualCamera(const Snapshot& snapshot, const Camera& camera, double aspect, const PsmOptions& options);

/// Share of the post-perspective depth range of `eye`, a virtual camera behind `camera`, between the near plane of `camera`
/// and twice its distance. Half of it if they are the same camera and the far plane is far (course, "Near/Far Selection").
double nearDepthShare(const Camera& camera, const Camera& eye, double aspect);

/// Perspective shadow map (Stamminger, Drettakis 2002; course, "Perspective Shadow Maps") of a hard light: its frustum
/// fitted in the space after the perspective of `camera`. The light becomes a point there, at infinity if it lies in the
/// camera's plane. Falls back to `fitToScene` where nothing visible lies in front of the light.
LightView fitPsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                 const PsmOptions& options);

} // namespace shadowbench::techniques
