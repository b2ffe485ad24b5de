// What a surface point sees of single points of an area light, by the edges around what hides it.
#pragma once

#include "scene/camera.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::groundtruth::area {

struct CoverEdge;     // groundtruth/cgal/area/area_view.h
struct CoverInterval; // the same

/// Sets of points on a rectangle, disk or line, prepared for many surface points.
class LightPoints {
public:
    /// Each set as parameters of Light::sample.
    LightPoints(LightKind kind, const std::vector<std::vector<glm::dvec2>>& sets);

    [[nodiscard]] const std::vector<int>& sizes() const { return sizes_; } // points of each set

    /// How many of each set are visible: of a rectangle or disk those whose winding number is not positive, of a line those
    /// that lie in no hidden part. Points as near to an edge as its rounding are decided either way.
    [[nodiscard]] std::vector<int> visible(const std::vector<CoverEdge>& edges) const;
    [[nodiscard]] std::vector<int> visible(const std::vector<CoverInterval>& hidden) const;

private:
    std::vector<int> sizes_;
    std::vector<double> x_, y_;      // light coordinates, by ascending y
    std::vector<std::uint32_t> set_; // that the point belongs to
};

} // namespace shadowbench::groundtruth::area
