// What a surface point sees in front of an area light, in light coordinates: (a, b) names the point centre + a u + b v.
#pragma once

#include "groundtruth/cgal/geometry/triangles.h"

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace shadowbench::groundtruth::area {

using namespace geometry;

/// A surface point: where `ray` meets the plane of `receiver`.
struct SurfacePoint {
    Ray ray;
    Triangle receiver;
};

/// A directed edge in light coordinates: `covers` more triangles hide what lies to its left (b upwards, a to the right) than
/// what lies to its right. The true end points lie within `error` per coordinate.
struct CoverEdge {
    glm::dvec2 from, to;
    int covers;
    double error;
};

/// A hidden part of a line light; the true ends lie within `error`.
struct CoverInterval {
    double from, to;
    double error;
};

/// The edges around the hidden part of the window of a rectangle or disk: winding numbers counted from the window's left
/// border are the numbers of triangles that cover. Edges whose error times length would exceed `tolerance` in interval
/// arithmetic are computed in rational numbers. Nothing if the point lies in the light's plane.
std::optional<std::vector<CoverEdge>> coverEdges(const SceneTriangles& scene, const Light& light, const SurfacePoint& point,
                                                 double tolerance);

/// The hidden parts of a line light; they may overlap. Nothing if the point lies on the light's line. Triangles that meet
/// the plane of point and light in no more than an edge count if they lie on its positive side: those around a shared edge
/// leave no gap. Ends whose error would exceed `tolerance` are computed in rational numbers.
std::optional<std::vector<CoverInterval>> coverIntervals(const SceneTriangles& scene, const Light& light,
                                                         const SurfacePoint& point, double tolerance);

/// The triangles of which some may hide a part of the light from the point.
std::vector<Triangle> areaCandidates(const SceneTriangles& scene, const Light& light, const SurfacePoint& point);

} // namespace shadowbench::groundtruth::area
