// Which directions are blocked from a point, by rays through all triangles of a snapshot: Embree, in single precision.
#pragma once

#include "scene/snapshot.h"
#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace shadowbench::techniques {

class OcclusionRays {
public:
    explicit OcclusionRays(const Snapshot& snapshot); // throws InternalError with Embree's error number
    ~OcclusionRays();
    OcclusionRays(const OcclusionRays&) = delete;
    OcclusionRays& operator=(const OcclusionRays&) = delete;

    /// Calls may run at once. `blocked[i]`: 1 where a ray from `point` along `samples[i]` meets a surface, 0 where it does
    /// not and for directions below the point's tangent plane.
    void trace(const SurfacePoint& point, std::span<const DirectionSample> samples, std::span<std::uint8_t> blocked) const;

    /// Whether what is above the point is the inner side of a closed body.
    [[nodiscard]] bool isInside(const SurfacePoint& point) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace shadowbench::techniques
