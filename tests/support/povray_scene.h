// Scenes that the POV-Ray and reference tests share.
#pragma once

#include "scene/meshes/primitives.h"
#include "scene/snapshot.h"

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

namespace shadowbench::groundtruth {

inline Batch placed(Mesh mesh, const glm::dmat4& world, std::uint32_t id) {
    return {std::make_shared<const Mesh>(std::move(mesh)), glm::vec3(0.8F), false, {{world, world, id}}};
}

inline glm::dmat4 at(const glm::dvec3& position) { return glm::translate(glm::dmat4(1), position); }

/// A ground seen from above, turned so that every pixel sees another distance to the edge; a thin box from x = 0 to x = 20
/// one metre above it hides a half-plane; a square light of side 2, parallel to the box's edge, two metres above the box.
/// The camera is so low that the box is behind it. Penumbra on the ground: x in (−½, ½), visible fraction ½ − x (similar
/// triangles, box of no thickness).
inline Snapshot halfPlane(LightKind kind) {
    Snapshot s;
    s.camera = {{0.013, 0.9, 0.017}, {0.013, 0, 0.017}, {0.3, 0, -1}, 100, 0.01, 50};
    s.previousCamera = s.camera;
    s.light = {kind, {0, 3, 0}, {0, -1, 0}, {2, 0, 0}, kind == LightKind::Line ? glm::dvec3(0) : glm::dvec3(0, 0, 2)};
    s.batches.push_back(placed(plane(30), glm::dmat4(1), 1));
    constexpr double thickness = 1e-4;
    s.batches.push_back(placed(box({20, thickness, 40}), at({10, 1, 0}), 2));
    return s;
}

/// Plates whose penumbrae overlap, after the scene of that name.
inline Snapshot overlappingPlates() {
    Snapshot s;
    s.camera = {{3.1, 4.2, 7.3}, {0, 0.6, 0}, {0, 1, 0}, 40, 0.1, 60};
    s.previousCamera = s.camera;
    s.light = {LightKind::Rectangle, {0.2, 8.1, 0.3}, {0, -1, 0}, {1.8, 0, 0.1}, {-0.1, 0, 1.8}};
    s.batches.push_back(placed(plane(20), glm::dmat4(1), 1));
    Batch plates = placed(box({2.0, 0.05, 1.2}), at({0, 1.1, 0}), 2);
    const glm::dmat4 turned = glm::rotate(at({0.4, 2.3, 0.2}), glm::radians(31.0), glm::dvec3(0, 1, 0));
    plates.placements.push_back({turned, turned, 3});
    s.batches.push_back(plates);
    return s;
}

} // namespace shadowbench::groundtruth
