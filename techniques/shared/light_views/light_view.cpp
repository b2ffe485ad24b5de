#include "techniques/shared/light_views/light_view.h"

#include "base/error.h"
#include "techniques/shared/light_views/fitting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowbench::techniques {
namespace {

/// Right, up and forward of a light's plane.
Camera::Basis lightBasis(const Light& light, const std::vector<glm::dvec3>& points) {
    Bounds box;
    for (const glm::dvec3& p : points) box.add(p);
    if (light.kind == LightKind::Rectangle || light.kind == LightKind::Disk) {
        // The map's plane is the light's own, its sides the light's sides, so that offsets on the light are offsets on the
        // map.
        glm::dvec3 axis = glm::normalize(glm::cross(light.u, light.v));
        if (glm::dot(axis, box.centre() - light.centre) < 0) axis = -axis;
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

LightView fitPerspective(const glm::dvec3& eye, const Camera::Basis& basis, std::vector<glm::dvec3> points) {
    const glm::dmat4 view = viewFrom(eye, basis);
    double near = std::numeric_limits<double>::infinity();
    double far = 0;
    for (const glm::dvec3& p : points) {
        const double depth = glm::dot(p - eye, basis.forward);
        near = std::min(near, depth);
        far = std::max(far, depth);
    }
    if (far <= 0) throw BadInput("the light looks away from the whole scene: no shadow map can be drawn from it");
    near = std::max(near * (1 - 1e-6), nearestShare * far);
    far *= 1 + 1e-6;

    Bounds slopes;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v(view * glm::dvec4(p, 1));
        const double depth = std::max(-v.z, near);
        slopes.add({std::clamp(v.x / depth, -steepest, steepest), std::clamp(v.y / depth, -steepest, steepest), 0});
    }
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

std::vector<glm::dvec3> boundingCorners(const Snapshot& snapshot) {
    std::vector<glm::dvec3> points;
    for (const Batch& batch : snapshot.batches) {
        const auto corners = batch.mesh->bounds().corners();
        for (const Placement& placement : batch.placements)
            for (const glm::dvec3& corner : corners) points.emplace_back(placement.world * glm::dvec4(corner, 1));
    }
    return points;
}

LightView fitToPoints(const Light& light, std::vector<glm::dvec3> points) {
    const Camera::Basis basis = lightBasis(light, points);
    if (light.kind == LightKind::Directional) return fitOrthographic(basis, std::move(points));
    return fitPerspective(light.centre, basis, std::move(points));
}

LightView fitFromSample(const Light& light, const glm::dvec3& sample, std::vector<glm::dvec3> points) {
    Light moved = light;
    moved.centre = sample;
    return fitToPoints(moved, std::move(points));
}

LightView fitToScene(const Light& light, const Snapshot& snapshot) { return fitToPoints(light, boundingCorners(snapshot)); }

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
