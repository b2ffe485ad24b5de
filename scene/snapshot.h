// The scene at one frame: what techniques draw and what the ground truth is computed for.
#pragma once

#include "scene/camera.h"
#include "scene/mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace shadowbench {

/// One drawn instance at one frame.
struct Placement {
    glm::dmat4 world;    // affine, world from object
    glm::dmat4 previous; // the same one frame earlier (equal to `world` in frame 0)
    std::uint32_t id; // of the surface: the instance's number in the scene, from 1, whatever frame and level; 0: background
};

/// All placements of one mesh.
struct Batch {
    std::shared_ptr<const Mesh> mesh;
    glm::vec3 colour;
    bool moving; // some placement differs from its previous one, or the mesh deforms
    std::vector<Placement> placements;
    std::shared_ptr<const Mesh> previousMesh{}; // of a mesh that deforms: its vertices one frame earlier, the same triangles

    [[nodiscard]] bool moves(const Placement& placement) const {
        return previousMesh != nullptr || placement.world != placement.previous;
    }
};

struct Snapshot {
    int frame = 0;
    Camera camera, previousCamera;
    Light light;
    std::vector<Batch> batches;

    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] std::size_t triangles() const;
};

} // namespace shadowbench
