// From a surface point onto the light's plane: homogeneous light coordinates, linear in the world point, over any number
// type.
#pragma once

#include "groundtruth/cgal/area_vector.h"
#include "harness/scene/camera.h"

namespace shadowbench::groundtruth {

/// Homogeneous light coordinates as seen from the point: the world point X is seen at (x / w, y / w), and w grows from 0 at
/// the point to `distance` at the light's plane. With D = centre − P and d = X − P, P + λ d = centre + a u + b v gives by
/// Cramer's rule a = d·(v × D) / d·(u × v), b = d·(D × u) / d·(u × v) and 1/λ = d·(u × v) / D·(u × v).
template <typename Number>
struct LightMap {
    AreaVector<Number> eye;
    AreaVector<Number> rowX, rowY, rowW;
    Number distance;

    /// `sense` is the sign of D·(u × v): the rows are turned so that w is positive towards the light.
    LightMap(const AreaVector<Number>& point, const Light& light, int sense) : eye(point) {
        const auto u = AreaVector<Number>::from(light.u), v = AreaVector<Number>::from(light.v);
        const AreaVector<Number> towards = AreaVector<Number>::from(light.centre) - eye;
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

    [[nodiscard]] AreaVector<Number> operator()(const glm::dvec3& world) const {
        const AreaVector<Number> d = AreaVector<Number>::from(world) - eye;
        return {dot(rowX, d), dot(rowY, d), dot(rowW, d)};
    }
};

} // namespace shadowbench::groundtruth
