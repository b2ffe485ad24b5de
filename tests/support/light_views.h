// What tests of light views share: scenes with known geometry and points seen through a view.
#pragma once

#include "scene/meshes/primitives.h"
#include "techniques/shared/light_views/light_view.h"

#include <glm/geometric.hpp>
#include <memory>

namespace shadowbench::techniques {

/// Map coordinates and depth of `p`, all in [−1, 1] inside the map.
inline glm::dvec3 mapped(const LightView& view, const glm::dvec3& p) {
    const glm::dvec4 h = view.clipFromWorld * glm::dvec4(p, 1);
    return glm::dvec3(h) / h.w;
}

inline Light sun(const glm::dvec3& direction) { return {LightKind::Directional, {}, glm::normalize(direction), {}, {}}; }

/// A slab 20 m wide and long, 0.1 m thick, under a camera that looks along −z over it.
inline Snapshot slabScene(const Light& light) {
    Snapshot snapshot;
    snapshot.camera = {{0, 2, 10}, {0, 2, -10}, {0, 1, 0}, 60, 1, 50};
    snapshot.light = light;
    snapshot.batches.push_back({std::make_shared<Mesh>(box({20, 0.1, 20})), {}, false, {{glm::dmat4(1), glm::dmat4(1), 1}}});
    return snapshot;
}

} // namespace shadowbench::techniques
