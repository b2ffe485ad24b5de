// The benchmark's scene: a bumpy body over a planar ground, a point light and a camera that sees mostly ground.
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "scene/meshes/primitives.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::benchmarks {

constexpr std::uint32_t groundId = 1;

inline Snapshot bumpyScene(int triangles) {
    Snapshot snapshot;
    snapshot.camera = {{0.4, 5.5, 6.5}, {0, 0.2, 0}, {0, 1, 0}, 45, 0.1, 60};
    snapshot.light = {LightKind::Point, {1.3, 6.1, 0.7}, {0, -1, 0}, glm::dvec3(0), glm::dvec3(0)};
    const glm::dmat4 body = glm::rotate(glm::translate(glm::dmat4(1), {0.1, 2.0, -0.2}), 0.4, glm::dvec3(0.6, 0.8, 0));
    const glm::dmat4 ground(1);
    snapshot.batches.push_back({std::make_shared<Mesh>(plane(8)), glm::vec3(0.8F), false, {{ground, ground, groundId}}});
    snapshot.batches.push_back(
        {std::make_shared<Mesh>(bumpy(1.2, 0.35, triangles, 7)), glm::vec3(0.8F), false, {{body, body, groundId + 1}}});
    return snapshot;
}

/// Leaves only the pixels that see the ground as receivers.
inline groundtruth::PrimaryHits groundOnly(groundtruth::PrimaryHits primary) {
    for (std::size_t i = 0; i < primary.id.size(); ++i)
        if (primary.id[i] != groundId) primary.surface[i] = groundtruth::Surface::Background;
    return primary;
}

} // namespace shadowbench::benchmarks
