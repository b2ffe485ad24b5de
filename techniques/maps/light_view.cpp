#include "techniques/maps/light_view.h"

#include "harness/scene/error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowbench::techniques {
namespace {

/// Axis-aligned box of points in some light space.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

glm::dvec3 divided(const glm::dvec4& h) { return glm::dvec3(h) / h.w; }

Extent extentOf(const glm::dmat4& transform, const std::vector<glm::dvec3>& points) {
    Extent extent;
    for (const glm::dvec3& p : points) extent.add(divided(transform * glm::dvec4(p, 1)));
    return extent;
}

/// Maps `extent` to [−1, 1]³, leaving `margin` (a share of the side) free on every side of x and y.
glm::dmat4 fitMatrix(const Extent& extent, double margin) {
    const glm::dvec3 size = glm::max(extent.high - extent.low, glm::dvec3(1e-12));
    const glm::dvec3 room(1 - 2 * margin, 1 - 2 * margin, 1);
    const glm::dmat4 scaled = glm::scale(glm::dmat4(1), 2.0 * room / size);
    return glm::translate(scaled, -0.5 * (extent.low + extent.high));
}

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

    Extent slopes;
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
    const Extent box = extentOf(view, points);
    const double slack = 1e-6 * (box.high.z - box.low.z);
    const double near = -box.high.z - slack;
    const double far = -box.low.z + slack;
    const glm::dmat4 projection = glm::ortho(box.low.x, box.high.x, box.low.y, box.high.y, near, far);
    return {projection * view, glm::dvec4(basis.forward, 0), near, far, false, glm::dvec2(box.high - box.low),
            std::move(points)};
}

using Polygon = std::vector<glm::dvec3>;

/// The part of a convex polygon where dot(plane, (p, 1)) ≥ 0; new corners are also appended to `cutPoints`.
Polygon cut(const Polygon& polygon, const glm::dvec4& plane, std::vector<glm::dvec3>& cutPoints) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(plane, glm::dvec4(a, 1));
        const double db = glm::dot(plane, glm::dvec4(b, 1));
        if (da >= 0) kept.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        kept.push_back(a + da / (da - db) * (b - a));
        cutPoints.push_back(kept.back());
    }
    return kept;
}

/// Sorts points of one plane around their middle, so that they bound a convex polygon.
void sortAround(Polygon& polygon, const glm::dvec3& normal) {
    const glm::dvec3 least = std::abs(normal.x) < std::abs(normal.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(normal, least));
    const glm::dvec3 y = glm::cross(glm::normalize(normal), x);
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : polygon) middle += p / static_cast<double>(polygon.size());
    const auto angle = [&](const glm::dvec3& p) { return std::atan2(glm::dot(p - middle, y), glm::dot(p - middle, x)); };
    std::sort(polygon.begin(), polygon.end(), [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
}

/// The convex body bounded by `faces` without what lies behind `plane`; the cut becomes a face.
std::vector<Polygon> cutBody(const std::vector<Polygon>& faces, const glm::dvec4& plane) {
    std::vector<Polygon> kept;
    Polygon lid;
    for (const Polygon& face : faces) {
        Polygon rest = cut(face, plane, lid);
        if (rest.size() >= 3) kept.push_back(std::move(rest));
    }
    if (lid.size() < 3) return kept;
    sortAround(lid, glm::dvec3(plane));
    kept.push_back(std::move(lid));
    return kept;
}

std::vector<Polygon> boxFaces(const Bounds& box) {
    const auto c = box.corners(); // corner i takes high.x, high.y, high.z where bit 0, 1, 2 of i is set
    constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    std::vector<Polygon> result;
    for (const auto& face : faces) result.push_back({c[face[0]], c[face[1]], c[face[2]], c[face[3]]});
    return result;
}

std::array<glm::dvec4, 6> frustumPlanes(const glm::dmat4& clipFromWorld) {
    const glm::dmat4 m = glm::transpose(clipFromWorld);
    return {m[3] + m[0], m[3] - m[0], m[3] + m[1], m[3] - m[1], m[3] + m[2], m[3] - m[2]};
}

} // namespace

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

std::vector<glm::dvec3> visiblePart(const Bounds& box, const Camera& camera, double aspect,
                                    const std::vector<glm::dvec4>& halfSpaces) {
    std::vector<Polygon> faces = boxFaces(box);
    for (const glm::dvec4& plane : frustumPlanes(camera.projection(aspect) * camera.view())) faces = cutBody(faces, plane);
    for (const glm::dvec4& plane : halfSpaces) faces = cutBody(faces, plane);
    std::vector<glm::dvec3> points;
    for (const Polygon& face : faces) points.insert(points.end(), face.begin(), face.end());
    return points;
}

LightView jittered(const LightView& view, double angle, glm::dvec2 shift, int texels) {
    LightView result = view;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 0, 1)) * view.clipFromWorld;
    Extent extent;
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

double lispsmNear(double d, double z0, double z1) {
    if (z0 <= 0 || z1 <= z0) return std::numeric_limits<double>::infinity();
    return d / (std::sqrt(z1 / z0) - 1);
}

LightView fitLispsm(const Light& light, const Snapshot& snapshot, double aspect) {
    LightView view = fitToScene(light.centreOnly(), snapshot);
    // Nothing of the scene is nearer to the light than the near plane, though corners of its bounding box may be.
    const glm::dvec4 nearPlane = view.depthFromWorld - glm::dvec4(0, 0, 0, view.near);
    std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), snapshot.camera, aspect, {nearPlane});
    if (body.size() < 3) return view; // nothing visible lies in front of the light

    // The view axis in light space, seen from the nearest point of the body (post-perspective for a point light).
    const glm::dvec3 forward = snapshot.camera.basis().forward;
    const auto eyeDepth = [&](const glm::dvec3& p) { return glm::dot(p - snapshot.camera.eye, forward); };
    const glm::dvec3 nearest =
        *std::min_element(body.begin(), body.end(), [&](const auto& a, const auto& b) { return eyeDepth(a) < eyeDepth(b); });
    double deepest = 0;
    for (const glm::dvec3& p : body) deepest = std::max(deepest, eyeDepth(p));
    const auto toLight = [&](const glm::dvec3& p) { return divided(view.clipFromWorld * glm::dvec4(p, 1)); };
    const glm::dvec3 start = toLight(nearest);
    const glm::dvec3 axis = toLight(nearest + 1e-4 * (deepest - eyeDepth(nearest)) * forward) - start;

    const double turn = std::atan2(axis.x, axis.y); // about z: brings the axis onto +y
    glm::dmat4 light2 = glm::rotate(glm::dmat4(1), turn, glm::dvec3(0, 0, 1)) * view.clipFromWorld;
    const Extent box = extentOf(light2, body);
    const glm::dvec3 e = divided(light2 * glm::dvec4(nearest, 1));

    // Two points of one line along y, at the near and far end of the body; the first on the plane through `nearest` parallel
    // to the image, the second a body's length further: their eye depths give the depth ratio that the warp has to even out.
    const glm::dvec4 plane = glm::transpose(glm::inverse(light2)) *
                             glm::dvec4(forward, -glm::dot(forward, nearest)); // the parallel plane, in light space
    const double z = std::abs(plane.z) > 1e-12 ? -(plane.x * e.x + plane.y * box.low.y + plane.w) / plane.z : e.z;
    const glm::dmat4 back = glm::inverse(light2);
    const double z0 = eyeDepth(divided(back * glm::dvec4(e.x, box.low.y, z, 1)));
    const double z1 = eyeDepth(divided(back * glm::dvec4(e.x, box.high.y, z, 1)));
    const double d = box.high.y - box.low.y;
    const double n = lispsmNear(d, z0, z1);

    if (std::isfinite(n) && n < 1e4 * d) {
        const glm::dvec3 centre(e.x, box.low.y - n, 0.5 * (box.low.z + box.high.z));
        const double f = n + d;
        // Perspective along +y: w = y; x and z are divided by it, so that light rays (along z) stay parallel.
        const glm::dmat4 warp(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, (f + n) / (f - n), 0, 1), glm::dvec4(0, 0, 1, 0),
                              glm::dvec4(0, -2 * f * n / (f - n), 0, 0));
        light2 = warp * glm::translate(glm::dmat4(1), -centre) * light2;
    }
    view.clipFromWorld = fitMatrix(extentOf(light2, body), 0) * light2;
    view.covered = std::move(body);
    return view;
}

} // namespace shadowbench::techniques
