// Outlines as a silhouette map holds them (course, "Shadow Silhouette Maps"; no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <glm/vec3.hpp>
#include <optional>

namespace shadowbench::techniques {

/// An edge on the dual grid of a depth map: x and y in texels, offset by half a texel so that the depth samples lie at the
/// corners of cells, and depth in [0, 1].
struct DualEdge {
    glm::vec3 from, to;
};

/// The world segment a–b in a map of `side` texels; its part behind the light is cut off. Nothing where all of it is.
std::optional<DualEdge> onDualGrid(const LightView& view, glm::dvec3 a, glm::dvec3 b, int side);

} // namespace shadowbench::techniques
