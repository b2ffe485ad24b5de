#include "techniques/maps/sm-tsm/tsm_view.h"

#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/visible_part.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace shadowbench::techniques {

double tsmCentre(double height, double focus, double rule) {
    // A perspective along y from a centre η before the top line maps distance d to (λ + η) d / (λ (d + η)) of the map.
    const double room = rule * height - focus;
    return room <= 0 ? std::numeric_limits<double>::infinity() : height * focus * (1 - rule) / room;
}

LightView fitTsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect, double focus) {
    constexpr double rule = 0.8;
    LightView view = fitToScene(light, snapshot);
    const glm::dvec4 nearPlane = view.depthFromWorld - glm::dvec4(0, 0, 0, view.near);
    std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, spaceOf(view));
    if (body.size() < 3) return view;
    // Clip space with the map's own proportions, so that right angles are right angles.
    glm::dmat4 plane = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * view.span, 1)) * view.clipFromWorld;

    // The centre line: the view axis between the nearest and the farthest visible depth, in front of the light.
    const DepthRange depths = visibleDepths(snapshot.bounds(), camera, aspect);
    const glm::dvec3 forward = camera.basis().forward;
    const auto onAxis = [&](double share) {
        return camera.eye + (depths.near + share * (depths.far - depths.near)) * forward;
    };
    const auto mapped = [&](const glm::dvec3& p) { return glm::dvec2(divided(plane * glm::dvec4(p, 1))); };
    const auto beforeLight = [&](const glm::dvec3& p) {
        return !view.perspective || glm::dot(nearPlane, glm::dvec4(p, 1)) >= 0;
    };
    const glm::dvec2 start = mapped(onAxis(0)), line = mapped(onAxis(1)) - start;
    const Bounds unwarped = boundsOf(plane, body);
    const bool degenerate = !beforeLight(onAxis(0)) || !beforeLight(onAxis(1)) ||
                            glm::length(line) < 1e-3 * glm::length(glm::dvec2(unwarped.high - unwarped.low));
    if (!degenerate) {
        plane = glm::rotate(glm::dmat4(1), std::atan2(line.x, line.y), glm::dvec3(0, 0, 1)) * plane; // brings it onto +y
        const Bounds box = boundsOf(plane, body);
        const double height = box.high.y - box.low.y;
        const double eta = tsmCentre(height, mapped(onAxis(focus)).y - box.low.y, rule);
        if (std::isfinite(eta) && eta > 0) {
            // w = distance from the centre of projection: the trapezoid's sides become parallel, light rays stay parallel.
            const glm::dvec2 centre(mapped(onAxis(0)).x, box.low.y - eta);
            const glm::dmat4 warp(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 0, 1), glm::dvec4(0, 0, 1, 0),
                                  glm::dvec4(0, -1, 0, 0));
            plane = warp * glm::translate(glm::dmat4(1), glm::dvec3(-centre, 0)) * plane;
        }
    }
    view.clipFromWorld = fitMatrix(boundsOf(plane, body), 0) * plane;
    view.covered = std::move(body);
    return view;
}

} // namespace shadowbench::techniques
