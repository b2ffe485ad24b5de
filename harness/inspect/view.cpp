#include "harness/inspect/view.h"

#include "base/srgb.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/exact.h"
#include "harness/metrics/frames.h"
#include "techniques/shared/light_views/light_view.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::inspect {
namespace {

using groundtruth::Surface;
using groundtruth::hard::ExactScene;

constexpr double mapSide = 1024;

/// Of an area light its centre, and the ends of its axes but for a hundredth: the rim itself may lie in a surface's plane.
std::vector<Light> pointsOf(const Light& light, bool all) {
    std::vector<Light> points{light.centreOnly()};
    if (!all || !light.isArea()) return points;
    for (const glm::dvec3& axis : {light.u, light.v})
        for (const double side : {-0.49, 0.49}) {
            if (axis == glm::dvec3(0)) continue;
            points.push_back(points.front());
            points.back().centre += side * axis;
        }
    return points;
}

} // namespace

View::View(const Snapshot& snapshot)
    : snapshot_(snapshot), triangles_(std::make_shared<const groundtruth::geometry::SceneTriangles>(snapshot)) {}

View::Seen View::seen(const Light& light, glm::ivec2 size, bool allPoints) const {
    Snapshot asked = snapshot_;
    asked.light = light;
    Seen seen{ExactScene(asked, triangles_).primaryHits(size), Image<float>(size.x, size.y), {}};
    const std::vector<Light> points = pointsOf(light, allPoints);
    for (const Light& point : points) {
        asked.light = point;
        groundtruth::Reference labels;
        ExactScene(asked, triangles_).labelByRays(size, seen.hits, labels);
        for (std::size_t i = 0; i < seen.visibility.size(); ++i)
            seen.visibility[i] += labels.visibility[i] / static_cast<float>(points.size());
    }

    FrameReport& report = seen.report;
    report.size = size;
    report.lightPoints = light.isEnvironment() ? 0 : static_cast<int>(points.size());
    for (std::size_t i = 0; i < seen.visibility.size(); ++i) {
        const Surface surface = seen.hits.surface[i];
        const float v = seen.visibility[i];
        report.background += surface == Surface::Background;
        report.facesAway += surface == Surface::FacesAway;
        if (surface != Surface::Receiver) continue;
        ++report.receivers;
        ++(v < 0.01F ? report.shadowed : v > 0.99F ? report.lit : report.penumbra);
    }
    for (double* share : {&report.lit, &report.shadowed, &report.penumbra})
        if (report.receivers > 0) *share /= report.receivers;
    for (double* share : {&report.receivers, &report.facesAway, &report.background})
        *share /= static_cast<double>(seen.visibility.size());
    return seen;
}

View::Hiding View::hides(const glm::dvec3& point) const {
    const Light light = snapshot_.light.centreOnly();
    Snapshot asked = snapshot_;
    const double reach = triangles_->reachFrom(point);
    asked.camera.eye = light.kind == LightKind::Directional ? point - reach * light.direction : light.centre;
    asked.camera.target = point;
    const double way = glm::distance(asked.camera.eye, point);
    const glm::dvec3 along = (point - asked.camera.eye) / way;
    asked.camera.up = std::abs(along.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    asked.camera.near = 1e-9 * way;
    asked.camera.far = way;
    const groundtruth::PrimaryHits hits = ExactScene(asked, triangles_).primaryHits({1, 1});
    return {hits.id(0, 0), glm::distance(asked.camera.eye, glm::dvec3(hits.position(0, 0)))};
}

Image<glm::vec3> View::normals(const groundtruth::PrimaryHits& hits) const {
    Image<glm::vec3> result(hits.id.width(), hits.id.height(), glm::vec3(0));
    for (std::size_t i = 0; i < hits.id.size(); ++i) {
        if (hits.id[i] == 0) continue;
        const auto [a, b, c] = triangles_->triangle({triangles_->instanceOf(hits.id[i]), hits.triangle[i]});
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        result[i] = glm::vec3(glm::dot(normal, snapshot_.camera.eye - a) < 0 ? -normal : normal);
    }
    return result;
}

Image<glm::vec3> View::picture(const Seen& seen) const {
    const metrics::Drawn drawn{seen.hits.id, seen.hits.position};
    Image<glm::vec3> picture = metrics::shaded(metrics::shading(snapshot_, drawn, normals(seen.hits)), seen.visibility);
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = forScreen(seen.hits.id[i] == 0 ? metrics::shownBackground : picture[i]);
    return picture;
}

std::optional<metrics::Aliasing> View::texels(const Seen& seen) const {
    if (snapshot_.light.isEnvironment()) return {};
    metrics::Mask mask{Image<std::uint8_t>(seen.visibility.width(), seen.visibility.height())};
    for (std::size_t i = 0; i < mask.scored.size(); ++i) {
        mask.scored[i] = seen.hits.surface[i] == Surface::Receiver;
        mask.count += mask.scored[i];
    }
    const techniques::LightView view = techniques::fitToScene(snapshot_.light.centreOnly(), snapshot_);
    const metrics::MapPoint mapPoint = [&](const glm::dvec3& world) {
        return techniques::texelAt(view, world, glm::dvec2(mapSide));
    };
    return metrics::aliasing({snapshot_.camera, seen.hits.position, normals(seen.hits), mask, mapPoint});
}

} // namespace shadowbench::inspect
