#include "techniques/shared/light_views/light_view.h"

#include "base/error.h"
#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowbench::techniques {
namespace {

/// Right, up and forward of a light's plane; `target` as in `fitToPoints`.
Camera::Basis lightBasis(const Light& light, const std::vector<glm::dvec3>& points, const glm::dvec3& target) {
    Bounds box;
    for (const glm::dvec3& p : points) box.add(p);
    if (light.kind == LightKind::Rectangle || light.kind == LightKind::Disk) {
        // The map's plane is the light's own, its sides the light's sides, so that offsets on the light are offsets on the
        // map.
        glm::dvec3 axis = glm::normalize(glm::cross(light.u, light.v));
        const bool within = glm::clamp(target, box.low, box.high) == target;
        double side = within ? glm::dot(axis, target - light.centre) : 0;
        // A target in the light's plane is on no side; what rounding leaves must not choose one.
        if (std::abs(side) <= 1e-6 * glm::distance(target, light.centre)) side = glm::dot(axis, box.centre() - light.centre);
        if (side < 0) axis = -axis;
        const glm::dvec3 right = glm::normalize(light.u);
        return {right, glm::cross(right, axis), axis};
    }
    if (light.kind == LightKind::Line) {
        const glm::dvec3 right = glm::normalize(light.u);
        const glm::dvec3 offset = box.centre() - light.centre;
        const glm::dvec3 axis = glm::normalize(offset - glm::dot(offset, right) * right);
        return {right, glm::cross(right, axis), axis};
    }
    const glm::dvec3 axis =
        light.kind == LightKind::Directional ? light.direction : glm::normalize(box.centre() - light.centre);
    const glm::dvec3 hint = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, hint));
    return {right, glm::cross(right, axis), axis};
}

/// View matrix that looks along `basis.forward` from `eye` (−z forward).
glm::dmat4 viewFrom(const glm::dvec3& eye, const Camera::Basis& basis) {
    const glm::dmat4 rows(glm::dvec4(basis.right, -glm::dot(basis.right, eye)),
                          glm::dvec4(basis.up, -glm::dot(basis.up, eye)),
                          glm::dvec4(-basis.forward, glm::dot(basis.forward, eye)), glm::dvec4(0, 0, 0, 1));
    return glm::transpose(rows);
}

constexpr double nearestShare = 0.01;                 // of the far distance
const double steepest = std::tan(glm::radians(80.0)); // off the axis

/// The least depth of a triangle's part within a pyramid from the eye; infinity where none is. All in the view's space.
double leastDepth(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec4, 4>& sides) {
    for (const glm::dvec4& side : sides)
        if (std::ranges::all_of(corners, [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(side), p) < 0; }))
            return std::numeric_limits<double>::infinity();
    std::vector<glm::dvec3> part(corners.begin(), corners.end());
    for (const glm::dvec4& side : sides) part = cut(part, side);
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : part) least = std::min(least, -p.z);
    return least;
}

/// The same of all of the scene. `view`: of the light; `slopes`: of the pyramid's sides.
double leastDepth(const Snapshot& scene, const glm::dmat4& view, const Bounds& slopes) {
    const std::array<glm::dvec4, 4> sides{
        glm::dvec4(1, 0, slopes.low.x, 0), {-1, 0, -slopes.high.x, 0}, {0, 1, slopes.low.y, 0}, {0, -1, -slopes.high.y, 0}};
    double least = std::numeric_limits<double>::infinity();
    for (const Batch& batch : scene.batches) {
        const Bounds box = batch.mesh->bounds();
        for (const Placement& placement : batch.placements) {
            const glm::dmat4 fromObject = view * placement.world;
            if (-transformed(box, fromObject).high.z >= least) continue;
            std::vector<glm::dvec3> seen;
            for (const glm::vec3& p : batch.mesh->positions) seen.emplace_back(fromObject * glm::dvec4(p, 1));
            for (const glm::uvec3& t : batch.mesh->triangles)
                if (-std::max({seen[t.x].z, seen[t.y].z, seen[t.z].z}) < least)
                    least = std::min(least, leastDepth({seen[t.x], seen[t.y], seen[t.z]}, sides));
        }
    }
    return least;
}

/// `scene`: whose parts before the light give the near distance where points are nearer than the limit; else it is the
/// limit.
LightView fitPerspective(const glm::dvec3& eye, const Camera::Basis& basis, std::vector<glm::dvec3> points,
                         const Snapshot* scene = nullptr) {
    const glm::dmat4 view = viewFrom(eye, basis);
    double near = std::numeric_limits<double>::infinity();
    double far = 0;
    for (const glm::dvec3& p : points) {
        const double depth = glm::dot(p - eye, basis.forward);
        near = std::min(near, depth);
        far = std::max(far, depth);
    }
    if (far <= 0) throw BadInput("the light looks away from the whole scene: no shadow map can be drawn from it");
    const bool held = near * (1 - 1e-6) < nearestShare * far;
    near = std::max(near * (1 - 1e-6), nearestShare * far);
    far *= 1 + 1e-6;

    Bounds slopes;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v(view * glm::dvec4(p, 1));
        const double depth = std::max(-v.z, near);
        slopes.add({std::clamp(v.x / depth, -steepest, steepest), std::clamp(v.y / depth, -steepest, steepest), 0});
    }
    // Where the pyramid holds nothing but what lies at the far distance, the range of depths still needs some extent.
    if (held && scene != nullptr) near = std::clamp(leastDepth(*scene, view, slopes) * (1 - 1e-6), near, 0.5 * far);
    const glm::dmat4 projection =
        glm::frustum(slopes.low.x * near, slopes.high.x * near, slopes.low.y * near, slopes.high.y * near, near, far);
    return {projection * view,
            glm::dvec4(basis.forward, -glm::dot(basis.forward, eye)),
            near,
            far,
            true,
            glm::dvec2(slopes.high - slopes.low),
            std::move(points)};
}

LightView fitOrthographic(const Camera::Basis& basis, std::vector<glm::dvec3> points) {
    const glm::dmat4 view = viewFrom(glm::dvec3(0), basis);
    const Bounds box = boundsOf(view, points);
    const double slack = 1e-6 * (box.high.z - box.low.z);
    const double near = -box.high.z - slack;
    const double far = -box.low.z + slack;
    const glm::dmat4 projection = glm::ortho(box.low.x, box.high.x, box.low.y, box.high.y, near, far);
    return {projection * view, glm::dvec4(basis.forward, 0), near, far, false, glm::dvec2(box.high - box.low),
            std::move(points)};
}

} // namespace

std::optional<glm::dvec2> texelAt(const LightView& view, const glm::dvec3& world, const glm::dvec2& size) {
    const glm::dvec4 h = view.clipFromWorld * glm::dvec4(world, 1);
    const glm::dvec2 at = glm::dvec2(h) / h.w;
    const bool inside = h.w > 0 && std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
    return inside ? std::optional((0.5 * at + 0.5) * size) : std::nullopt;
}

bool holds(const LightView& view, const glm::dvec3& p) {
    const glm::dvec4 h = view.clipFromWorld * glm::dvec4(p, 1);
    constexpr double rounding = 1 + 1e-9;
    return h.w > 0 && std::max({std::abs(h.x), std::abs(h.y), std::abs(h.z)}) <= h.w * rounding;
}

std::vector<glm::dvec4> spaceOf(const LightView& view) {
    std::vector<glm::dvec4> space{view.depthFromWorld - glm::dvec4(0, 0, 0, view.near)};
    if (std::ranges::all_of(view.covered, [&](const glm::dvec3& p) { return holds(view, p); })) return space;
    const std::array<glm::dvec4, 6> frustum = frustumPlanes(view.clipFromWorld);
    space.insert(space.end(), frustum.begin(), frustum.begin() + 4);
    return space;
}

std::vector<glm::dvec3> boundingCorners(const Snapshot& snapshot) {
    std::vector<glm::dvec3> points;
    for (const Batch& batch : snapshot.batches) {
        const auto corners = batch.mesh->bounds().corners();
        for (const Placement& placement : batch.placements)
            for (const glm::dvec3& corner : corners) points.emplace_back(placement.world * glm::dvec4(corner, 1));
    }
    return points;
}

LightView fitToPoints(const Light& light, std::vector<glm::dvec3> points, const glm::dvec3& target) {
    const Camera::Basis basis = lightBasis(light, points, target);
    if (light.kind == LightKind::Directional) return fitOrthographic(basis, std::move(points));
    return fitPerspective(light.centre, basis, std::move(points));
}

LightView fitFromSample(const Light& light, const glm::dvec3& sample, const Snapshot& snapshot) {
    Light moved = light;
    moved.centre = sample;
    return fitToScene(moved, snapshot);
}

LightView fitToScene(const Light& light, const Snapshot& snapshot) {
    std::vector<glm::dvec3> corners = boundingCorners(snapshot);
    if (!light.isArea()) return fitToPoints(light, std::move(corners), snapshot.camera.target);
    const Camera::Basis basis = lightBasis(light, corners, snapshot.camera.target);
    return fitPerspective(light.centre, basis, std::move(corners), &snapshot);
}

LightView jittered(const LightView& view, double angle, glm::dvec2 shift, int texels) {
    LightView result = view;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 0, 1)) * view.clipFromWorld;
    Bounds extent;
    for (const glm::dvec3& p : view.covered) {
        // Points that the unturned map holds at its rim (behind or beside the light) must not blow up the turned one.
        const glm::dvec4 h = view.clipFromWorld * glm::dvec4(p, 1);
        const glm::dvec3 held = h.w > 0 ? glm::clamp(divided(h), glm::dvec3(-1), glm::dvec3(1)) : glm::dvec3(0);
        const glm::dvec3 q(glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 0, 1)) * glm::dvec4(held, 1));
        extent.add({q.x, q.y, held.z});
    }
    extent.low.z = -1; // depth stays as it was
    extent.high.z = 1;
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), glm::dvec3(2.0 * shift / static_cast<double>(texels), 0));
    result.clipFromWorld = moved * fitMatrix(extent, 0.5 / texels) * turned;
    return result;
}

} // namespace shadowbench::techniques
