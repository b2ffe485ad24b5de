// A figure that walks on the spot.
#pragma once

#include "scene/meshes/skinning.h"

namespace shadowbench {

/// Standing on y = 0 (its soles reach a centimetre below), facing +z, 1.75 m high: torso, head, arms, legs and feet, each a
/// closed part of its own. The most triangles that are not above `triangles`, and at least 328.
SkinnedMesh walkerAtRest(int triangles);

/// Its bones at `share` (of 1) of a walking cycle: two steps, arms against legs. The lower foot stands on the ground.
std::vector<glm::dmat4> walkerBones(double share);

/// Pose `pose` of `poses` that are one cycle. Closed.
Mesh walker(int triangles, int pose, int poses);

} // namespace shadowbench
