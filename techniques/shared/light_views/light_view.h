// How a shadow map looks at the scene: fitting of the light frustum (no GL).
#pragma once

#include "scene/snapshot.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

/// A shadow map's projection. Depth grows away from the light.
struct LightView {
    glm::dmat4 clipFromWorld{1};
    glm::dvec4 depthFromWorld{0}; // dot(·, (p, 1)) = metres from the light's plane along its axis
    double near = 0, far = 1;     // that depth at clip z = −1 and +1 (before any warp)
    bool perspective = false;     // point light
    glm::dvec2 span{0}; // width and height of the map at unit depth (perspective) or in metres (orthographic), unwarped
    std::vector<glm::dvec3> covered;    // world points that the map must hold
    glm::dvec4 casterPlane{0, 0, 0, 1}; // casters count where dot(·, (p, 1)) ≥ 0, for maps that cut them (`DepthMap`)
};

/// Where `world` lies in a map of `size` texels drawn with `view`, in texels; nothing beside the map or behind the light.
/// The same as mapPoint() of shared/maps/light_space.glsl (compared in tests/techniques/gl/map_point_test.cpp).
std::optional<glm::dvec2> texelAt(const LightView& view, const glm::dvec3& world, const glm::dvec2& size);

/// Whether the point is in the view without being held at its limits (`fitToPoints`).
bool holds(const LightView& view, const glm::dvec3& p);

/// Half-spaces dot(plane, (p, 1)) ≥ 0 of what the view holds. Nothing of the scene is nearer to the light than its near
/// plane, though corners of its bounding box may be; its sides are among them only where points are held at the limits.
std::vector<glm::dvec4> spaceOf(const LightView& view);

/// World corners of the bounding boxes of all placements.
std::vector<glm::dvec3> boundingCorners(const Snapshot& snapshot);

/// The light frustum fitted to `points` (Scherzer 2.2; course, "Shadow Mapping"). A point or area light looks from its
/// centre: along its normal if it is a flat area light (at right angles to a line light), else towards the middle of the
/// points; a directional light is orthographic. A flat light looks to the side of its plane that `target`, the camera's, is
/// on; where that is in the plane or beside the points, to the side of their middle. Points nearer to the light's plane than
/// a hundredth of the far distance, or more than 80° off the axis, are held at that limit: a single map cannot see behind
/// its light.
LightView fitToPoints(const Light& light, std::vector<glm::dvec3> points, const glm::dvec3& target);

/// The view of point `sample` of an area light over the whole scene, its plane parallel to the light's.
LightView fitFromSample(const Light& light, const glm::dvec3& sample, const Snapshot& snapshot);

/// `fitToPoints` over the whole scene. Where points are held at the least distance, the view of an area light begins at the
/// nearest part of a triangle that it holds: a room that reaches above its lamp is not next to the lamp.
LightView fitToScene(const Light& light, const Snapshot& snapshot);

/// The same view rasterised differently: the projection window turned by `angle` (radians), re-fitted to the covered points,
/// and shifted by `shift` texels (each in [−½, ½]) of a map of `texels` per side (EGSR paper, 3.3).
LightView jittered(const LightView& view, double angle, glm::dvec2 shift, int texels);

} // namespace shadowbench::techniques
