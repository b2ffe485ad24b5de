// The rules: what of a scene is probably not as it was meant.
#pragma once

#include "harness/inspect/view.h"

namespace shadowbench::inspect {

/// What the rules are about. `seen` is the frame as the camera sees it.
struct Evidence {
    const Scene& scene;
    const Snapshot& snapshot;
    const Bounds& box;
    const View& view;
    const View::Seen& seen;
};

/// In the order in which they should be followed: sizes and axes, meshes, light, frame.
std::vector<Warning> warningsOf(const Evidence& evidence, const std::vector<MeshReport>& meshes);

} // namespace shadowbench::inspect
