// Where points of surfaces were one frame earlier.
#pragma once

#include "scene/snapshot.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <unordered_map>

namespace shadowbench::metrics {

class SurfaceMotion {
public:
    explicit SurfaceMotion(const Snapshot& now);

    /// World position in the previous frame of what is at `point` of surface `id` now. On a mesh that deforms, that is the
    /// same place in the triangle that lies nearest.
    [[nodiscard]] glm::dvec3 before(std::uint32_t id, const glm::dvec3& point) const;

private:
    struct Moving {
        const Batch* batch;
        const Placement* placement;
        glm::dmat4 fromWorld;
    };
    std::unordered_map<std::uint32_t, Moving> moving_; // by Placement::id
};

} // namespace shadowbench::metrics
