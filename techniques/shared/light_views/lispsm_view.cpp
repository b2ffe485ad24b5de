#include "techniques/shared/light_views/lispsm_view.h"

#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <vector>

namespace shadowbench::techniques {

double lispsmNear(double d, double z0, double z1) {
    if (z0 <= 0 || z1 <= z0) return std::numeric_limits<double>::infinity();
    return d / (std::sqrt(z1 / z0) - 1);
}

namespace {

/// The middle of what of `body` lies `first` before the eye. Where the near plane cuts the body these are several corners,
/// of which rounding alone would choose one.
glm::dvec3 middleAt(double first, double deepest, std::span<const glm::dvec3> body, const Camera& camera) {
    Bounds corners; // on an image of one pixel, and metres into it
    for (const glm::dvec3& p : body) {
        const glm::dvec3 seen = camera.project(p, {1, 1});
        if (seen.z <= first + 1e-9 * (deepest - first)) corners.add(seen);
    }
    return camera.eye + first * camera.ray(corners.centre(), {1, 1}); // within the corners, which are convex
}

} // namespace

TurnedLight turnedAlongView(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                            std::span<const glm::dvec4> within) {
    const LightView view = fitToScene(light, snapshot);
    std::vector<glm::dvec4> halfSpaces(within.begin(), within.end());
    std::ranges::copy(spaceOf(view), std::back_inserter(halfSpaces));
    std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, halfSpaces);
    if (body.size() < 3) return {.view = view}; // nothing visible lies in front of the light

    // The view axis in light space (post-perspective for a point light, where each parallel of the axis has a direction of
    // its own), from where the body begins: a corner of the body beside the axis would turn the map of a symmetric scene.
    const glm::dvec3 forward = camera.basis().forward;
    const auto eyeDepth = [&](const glm::dvec3& p) { return glm::dot(p - camera.eye, forward); };
    const auto byDepth = [&](const auto& a, const auto& b) { return eyeDepth(a) < eyeDepth(b); };
    const auto [first, last] = std::minmax_element(body.begin(), body.end(), byDepth);
    const double deepest = eyeDepth(*last);
    const glm::dvec3 onAxis = camera.eye + eyeDepth(*first) * forward;
    const bool lit = glm::dot(view.depthFromWorld, glm::dvec4(onAxis, 1)) > view.near;
    const glm::dvec3 nearest = lit ? onAxis : middleAt(eyeDepth(*first), deepest, body, camera);
    // Clip space with the map's own proportions, so that right angles are right angles.
    const glm::dmat4 light1 = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * view.span, 1)) * view.clipFromWorld;
    const auto toLight = [&](const glm::dvec3& p) { return divided(light1 * glm::dvec4(p, 1)); };
    const glm::dvec3 start = toLight(nearest);
    const glm::dvec3 axis = toLight(nearest + 1e-4 * (deepest - eyeDepth(nearest)) * forward) - start;

    const double turn = std::atan2(axis.x, axis.y); // about z: brings the axis onto +y
    const glm::dmat4 light2 = glm::rotate(glm::dmat4(1), turn, glm::dvec3(0, 0, 1)) * light1;
    const Bounds box = boundsOf(light2, body);
    const glm::dvec3 e = divided(light2 * glm::dvec4(nearest, 1));

    // Two points of one line along y, at the near and far end of the body; the first on the plane through `nearest` parallel
    // to the image, the second a body's length further: their eye depths give the depth ratio that the warp has to even out.
    const glm::dvec4 plane = glm::transpose(glm::inverse(light2)) *
                             glm::dvec4(forward, -glm::dot(forward, nearest)); // the parallel plane, in light space
    const double z = std::abs(plane.z) > 1e-12 ? -(plane.x * e.x + plane.y * box.low.y + plane.w) / plane.z : e.z;
    const glm::dmat4 back = glm::inverse(light2);
    const double z0 = eyeDepth(divided(back * glm::dvec4(e.x, box.low.y, z, 1)));
    const double z1 = eyeDepth(divided(back * glm::dvec4(e.x, box.high.y, z, 1)));
    return {view, std::move(body), light2, box, e, z0, z1};
}

LightView fitLispsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                    std::span<const glm::dvec4> within) {
    TurnedLight seen = turnedAlongView(light, snapshot, camera, aspect, within);
    LightView view = std::move(seen.view);
    if (seen.body.size() < 3) return view;
    const Bounds& box = seen.box;
    const double d = box.high.y - box.low.y;
    const double n = lispsmNear(d, seen.z0, seen.z1);

    if (!std::isfinite(n) || n >= 1e4 * d) return fitFocused(light, snapshot, camera, aspect);

    const glm::dvec3 centre(seen.nearest.x, box.low.y - n, 0.5 * (box.low.z + box.high.z));
    const double f = n + d;
    // Perspective along +y: w = y; x and z are divided by it, so that light rays (along z) stay parallel.
    const glm::dmat4 warp(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, (f + n) / (f - n), 0, 1), glm::dvec4(0, 0, 1, 0),
                          glm::dvec4(0, -2 * f * n / (f - n), 0, 0));
    const glm::dmat4 warped = warp * glm::translate(glm::dmat4(1), -centre) * seen.plane;
    view.clipFromWorld = fitMatrix(boundsOf(warped, seen.body), 0) * warped;
    view.covered = std::move(seen.body);
    return view;
}

} // namespace shadowbench::techniques
