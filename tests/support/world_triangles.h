// The triangles of a snapshot in the world, for models that go through every one of them.
#pragma once

#include "scene/snapshot.h"

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench {

using WorldTriangle = std::array<glm::dvec3, 3>;

inline std::vector<WorldTriangle> worldTriangles(const Snapshot& snapshot) {
    std::vector<WorldTriangle> triangles;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements)
            for (const glm::uvec3& t : batch.mesh->triangles) {
                const auto corner = [&](unsigned i) {
                    return glm::dvec3(placement.world * glm::dvec4(glm::dvec3(batch.mesh->positions[i]), 1));
                };
                triangles.push_back({corner(t.x), corner(t.y), corner(t.z)});
            }
    return triangles;
}

} // namespace shadowbench
