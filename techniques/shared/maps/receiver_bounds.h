// Where the camera's visible points lie, from the G-buffer: the reduction by which sample distribution shadow maps are
// fitted (Lauritzen, Salvi, Lefohn 2011).
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/shared/light_views/cascades.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

class ReceiverBounds {
public:
    /// For `ranges` ranges of eye depth.
    explicit ReceiverBounds(int ranges);

    /// Least and greatest eye depth dot(eyeDepthFromWorld, (p, 1)) of the frame's visible points p; nothing where it shows
    /// none.
    std::optional<DepthRange> depths(const Frame& frame, const glm::dvec4& eyeDepthFromWorld);

    /// For each of the `ranges`, ends included, the box of the visible points in it after the projective map
    /// `clipFromWorld`, of which those with w ≤ 0 are left out; nothing where there are none. The first and the last range
    /// also hold what lies beyond them.
    std::vector<std::optional<Bounds>> boxes(const Frame& frame, const glm::dvec4& eyeDepthFromWorld,
                                             std::vector<DepthRange> ranges, const glm::dmat4& clipFromWorld);

private:
    std::vector<std::optional<Bounds>> reduce(gl::Program& program, const Frame& frame, const glm::dvec4& eyeDepthFromWorld,
                                              const std::vector<DepthRange>& ranges, const glm::dmat4& clipFromWorld);

    gl::Program depthReduction_, boxReduction_;
    gl::Buffer extremes_;
};

} // namespace shadowbench::techniques
