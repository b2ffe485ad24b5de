#include "techniques/maps/sm-psm/psm_view.h"

#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::techniques {
namespace {

constexpr double farthest = 1e6; // post-perspective distance of a light at infinity
// A light close to the post-perspective body needs nearly the half turn that one map has, and must not lose receivers: wider
// limits than fitToPoints has.
constexpr double nearestShare = 0.001;                // of the far distance, and
const double steepest = std::tan(glm::radians(89.5)); // off the axis

/// Least and greatest of a quantity.
struct Interval {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
    [[nodiscard]] double half() const { return std::max(0.5 * (high - low), 1e-12); }
};

/// Where the camera must stand so that no part of the scene is behind it: metres behind `camera`.
double clearance(const Snapshot& snapshot, const Camera& camera) {
    const glm::dvec3 forward = camera.basis().forward;
    double needed = 0;
    for (const glm::dvec3& p : boundingCorners(snapshot)) needed = std::max(needed, -glm::dot(p - camera.eye, forward));
    return needed;
}

/// Points to be held by the map, in clip space of the virtual camera.
std::vector<glm::dvec4> inClipSpace(const std::vector<glm::dvec3>& body, const glm::dmat4& clipFromWorld, PsmBody kind) {
    std::vector<glm::dvec4> points;
    if (kind == PsmBody::Cube)
        for (int i = 0; i < 8; ++i)
            points.emplace_back(i % 2 == 0 ? -1 : 1, i / 2 % 2 == 0 ? -1 : 1, i / 4 == 0 ? -1 : 1, 1);
    else
        for (const glm::dvec3& p : body) points.push_back(clipFromWorld * glm::dvec4(p, 1));
    return points;
}

/// Axis of the narrowest cone around directions of unit length, if it is narrower than a half turn. Two or three of the
/// directions lie on it. A light close to what it lights needs nearly all of the half turn that one map has, so no
/// approximation will do.
glm::dvec3 coneAxis(const std::vector<glm::dvec3>& directions) {
    glm::dvec3 best = directions.front();
    double most = -1; // cosine of the cone's half angle
    const auto consider = [&](const glm::dvec3& axis) {
        if (!(glm::length(axis) > 1e-12)) return;
        const glm::dvec3 unit = glm::normalize(axis);
        double least = 1;
        for (const glm::dvec3& d : directions)
            if ((least = std::min(least, glm::dot(unit, d))) <= most) return;
        most = least;
        best = unit;
    };
    consider(best);
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            consider(directions[i] + directions[j]);
            for (std::size_t k = 0; k < j; ++k) {
                const glm::dvec3 normal = glm::cross(directions[i] - directions[k], directions[j] - directions[k]);
                consider(normal);
                consider(-normal);
            }
        }
    return best;
}

/// Projection from the homogeneous point `light` onto a map that just holds `points` (w > 0), all in one projective space.
/// On every ray from the light, depth grows away from it, whichever way the ray runs in that space.
glm::dmat4 projectionFrom(glm::dvec4 light, const std::vector<glm::dvec4>& points) {
    const double least = glm::length(glm::dvec3(light)) / farthest;
    if (std::abs(light.w) < least) light.w = light.w < 0 ? -least : least;
    const glm::dvec3 centre = divided(light);

    std::vector<glm::dvec3> directions; // each once: corners of the body come with every face
    for (const glm::dvec4& q : points) {
        const glm::dvec3 direction = glm::normalize(divided(q) - centre);
        if (std::ranges::none_of(directions, [&](const auto& known) { return glm::distance(known, direction) < 1e-9; }))
            directions.push_back(direction);
    }
    const glm::dvec3 axis = coneAxis(directions);
    const glm::dvec3 hint = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, hint)), up = glm::cross(right, axis);
    // Rows that give coordinates relative to the light, times the point's w.
    const auto row = [&](const glm::dvec3& direction) { return glm::dvec4(direction, -glm::dot(direction, centre)); };
    const glm::dvec4 x = row(right), y = row(up), distance = row(axis);

    Interval distances, slopesX, slopesY, inverse;
    for (const glm::dvec4& q : points) distances.add(glm::dot(distance, q) / q.w);
    const double nearest = std::max(distances.low, nearestShare * distances.high);
    for (const glm::dvec4& q : points) {
        const double d = std::max(glm::dot(distance, q) / q.w, nearest);
        slopesX.add(std::clamp(glm::dot(x, q) / q.w / d, -steepest, steepest));
        slopesY.add(std::clamp(glm::dot(y, q) / q.w / d, -steepest, steepest));
        inverse.add(1 / d);
    }
    // 1 / distance falls along the rays of a light; with w < 0 the light is a sink, its rays run the other way.
    const double sense = light.w < 0 ? 1 : -1;
    const glm::dvec4 constant(0, 0, 0, 1);
    const glm::dmat4 rows((x - slopesX.middle() * distance) / slopesX.half(),
                          (y - slopesY.middle() * distance) / slopesY.half(),
                          sense * (constant - inverse.middle() * distance) / inverse.half(), distance);
    return glm::transpose(rows) / distances.high;
}

} // namespace

Camera movedBack(const Camera& camera, double shift) {
    Camera moved = camera;
    moved.eye -= shift * camera.basis().forward;
    moved.near += shift;
    moved.far += shift;
    moved.fovy = glm::degrees(2 * std::atan(std::tan(glm::radians(0.5 * camera.fovy)) * camera.far / moved.far));
    return moved;
}

Camera virtualCamera(const Snapshot& snapshot, const Camera& camera, double aspect, const PsmOptions& options) {
    Camera shortened = camera;
    shortened.far = visibleDepths(snapshot.bounds(), camera, aspect).far;
    double shift = options.shift;
    if (options.behindEye == BehindEye::MoveBack) shift = std::max(shift, clearance(snapshot, shortened));
    return movedBack(shortened, shift);
}

double nearDepthShare(const Camera& camera, const Camera& eye, double aspect) {
    const glm::dmat4 clipFromWorld = eye.projection(aspect) * eye.view();
    const auto depth = [&](double distance) { // in [0, 1]
        const glm::dvec3 onAxis = camera.eye + distance * camera.basis().forward;
        return 0.5 + 0.5 * divided(clipFromWorld * glm::dvec4(onAxis, 1)).z;
    };
    return depth(2 * camera.near) - depth(camera.near);
}

LightView fitPsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                 const PsmOptions& options) {
    LightView view = fitToScene(light, snapshot);
    const glm::dvec4 nearPlane = view.depthFromWorld - glm::dvec4(0, 0, 0, view.near);
    std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, {&nearPlane, 1});
    if (body.size() < 3) return view;

    const Camera eye = virtualCamera(snapshot, camera, aspect, options);
    const glm::dmat4 clipFromWorld = eye.projection(aspect) * eye.view();

    const std::vector<glm::dvec4> points = inClipSpace(body, clipFromWorld, options.body);
    view.clipFromWorld = projectionFrom(clipFromWorld * light.homogeneous(), points) * clipFromWorld;
    view.covered = std::move(body);
    if (options.behindEye == BehindEye::Lost) {
        const glm::dvec3 forward = eye.basis().forward;
        view.casterPlane = glm::dvec4(forward, -glm::dot(forward, eye.eye) - 0.5 * eye.near);
    }
    return view;
}

} // namespace shadowbench::techniques
