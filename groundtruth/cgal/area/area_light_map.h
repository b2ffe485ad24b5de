// From a surface point onto the light's plane: homogeneous light coordinates, linear in the world point, over any number
// type.
#pragma once

#include "groundtruth/cgal/geometry/vector.h"
#include "scene/camera.h"

namespace shadowbench::groundtruth::area {

using namespace geometry;

/// Homogeneous light coordinates as seen from the point: the world point X is seen at (x / w, y / w), and w grows from 0 at
/// the point to `distance` at the light's plane. With D = centre − P and d = X − P, P + λ d = centre + a u + b v gives by
/// Cramer's rule a = d·(v × D) / d·(u × v), b = d·(D × u) / d·(u × v) and 1/λ = d·(u × v) / D·(u × v).
///
/// The point is head + rest, where `head` has double coordinates: close to it, d = (X − head) − rest keeps its relative
/// accuracy.
template <typename Number>
struct LightMap {
    Vector<Number> head, rest;
    Vector<Number> rowX, rowY, rowW;
    Number distance;

    /// `sense` is the sign of D·(u × v): the rows are turned so that w is positive towards the light.
    LightMap(const Vector<Number>& pointHead, const Vector<Number>& pointRest, const Light& light, int sense)
        : head(pointHead), rest(pointRest) {
        const auto u = vector<Number>(light.u), v = vector<Number>(light.v);
        const Vector<Number> towards = offset(light.centre);
        rowX = cross(v, towards);
        rowY = cross(towards, u);
        rowW = cross(u, v);
        if (sense < 0) {
            rowX = -rowX;
            rowY = -rowY;
            rowW = -rowW;
        }
        distance = dot(rowW, towards);
    }

    [[nodiscard]] Vector<Number> operator()(const glm::dvec3& world) const {
        const Vector<Number> d = offset(world);
        return {dot(rowX, d), dot(rowY, d), dot(rowW, d)};
    }

    /// From the point to a world point.
    [[nodiscard]] Vector<Number> offset(const glm::dvec3& world) const { return vector<Number>(world) - head - rest; }
};

} // namespace shadowbench::groundtruth::area
