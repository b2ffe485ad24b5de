// The walk of a scene frame by frame: what the camera may see and the level that each instance shows, the same for all
// level-of-detail techniques. No GL.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/lod_technique.h"

#include <vector>

namespace shadowbench::lod {

/// The levels of every object, by object.
std::vector<techniques::LodChain> chains(const Scene& scene);

/// A level by distance from the eye; in transition within half of `band` · Level::until on both sides of Level::until.
techniques::LodSelection select(const std::vector<Level>& levels, double band, double distance);

struct WalkFrame {
    Camera camera, previousCamera;                  // the same in frame 0
    std::vector<techniques::LodInstance> instances; // whose bounds the camera's frustum meets, by ascending id

    [[nodiscard]] std::size_t inTransition() const;
};

/// Throws BadInput where the scene has no walk.
WalkFrame walkFrame(const Scene& scene, int index, double aspect);

/// Camera and instances stand as in frame 0; the levels are those that the eye of frame `index` selects. What then changes
/// from one frame to the next is the change of levels and nothing else.
WalkFrame standingFrame(const Scene& scene, int index, double aspect);

/// The scene with the triangles of all meshes listed the other way round: the same surfaces in another order of drawing.
Scene withTrianglesReversed(const Scene& scene);

} // namespace shadowbench::lod
