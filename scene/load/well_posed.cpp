// Set-ups that have no defined answer: a light of no size or on a surface, an eye within a closed mesh, distances that
// shaders cannot multiply.
#include "base/error.h"
#include "scene/load/load.h"
#include "scene/load/scene_file.h"
#include "scene/mesh_faults.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace shadowbench {
namespace {

using Polygon = std::vector<glm::dvec3>; // convex: one point, a segment's two, or more

std::optional<Problem> sizeProblem(const Light& light) {
    if (!light.isArea()) return std::nullopt;
    if (!(glm::length(light.u) > 0)) return Problem{"light.u", "the light has no size; use a point light"};
    if (light.kind == LightKind::Line) return std::nullopt;
    if (!(glm::length(light.v) > 0)) return Problem{"light.v", "the light has no size; use a line or a point light"};
    const double sides = glm::length(light.u) * glm::length(light.v);
    if (!(glm::length(glm::cross(light.u, light.v)) > 1e-9 * sides))
        return Problem{"light.v", "is parallel to u: the light has no area; use a line"};
    if (light.kind == LightKind::Disk && std::abs(glm::dot(light.u, light.v)) > 1e-6 * sides)
        return Problem{"light.v", "the diameters of a disk are at right angles, these are not"};
    return std::nullopt;
}

std::optional<Problem> viewProblem(const Camera& camera) {
    const glm::dvec3 forward = camera.target - camera.eye;
    if (!(glm::length(forward) > 0)) return Problem{"camera.target", "the camera looks at its own eye"};
    const double sine = glm::length(glm::cross(forward, camera.up)) / (glm::length(forward) * glm::length(camera.up));
    if (!(sine > 1e-6)) return Problem{"camera.up", "up is zero or parallel to the line of sight"};
    return std::nullopt;
}

/// Scales multiply what is bounded one by one, and sweeps move what a file has bounded.
std::optional<Problem> reachProblem(const Snapshot& frame) {
    const auto isFar = [](const glm::dvec3& point) {
        return !glm::all(glm::lessThanEqual(glm::abs(point), glm::dvec3(kLargestNumber)));
    };
    const std::string where = fmt::format("farther than {:g} m from the origin at frame {}", kLargestNumber, frame.frame);
    const Light& light = frame.light;
    if (isFar(frame.camera.eye)) return Problem{"camera.eye", fmt::format("lies {}; move it nearer", where)};
    if (isFar(light.centre) || isFar(light.u) || isFar(light.v))
        return Problem{"light.centre", fmt::format("the light reaches {}; move it nearer", where)};
    const Bounds all = frame.bounds();
    if (!all.empty() && (isFar(all.low) || isFar(all.high)))
        return Problem{"object", fmt::format("an object reaches {}; make it smaller or move it nearer", where)};
    return std::nullopt;
}

/// The light's own shape; a disk as a polygon of 64 corners.
Polygon shapeOf(const Light& light) {
    switch (light.kind) {
    case LightKind::Point:
        return {light.centre};
    case LightKind::Line:
        return {light.centre - 0.5 * light.u, light.centre + 0.5 * light.u};
    case LightKind::Rectangle:
        return {light.centre - 0.5 * light.u - 0.5 * light.v, light.centre + 0.5 * light.u - 0.5 * light.v,
                light.centre + 0.5 * light.u + 0.5 * light.v, light.centre - 0.5 * light.u + 0.5 * light.v};
    case LightKind::Disk: {
        constexpr int kCorners = 64;
        Polygon rim;
        for (int i = 0; i < kCorners; ++i) {
            const double angle = glm::two_pi<double>() * i / kCorners;
            rim.push_back(light.centre + 0.5 * std::cos(angle) * light.u + 0.5 * std::sin(angle) * light.v);
        }
        return rim;
    }
    case LightKind::Directional:
    case LightKind::Environment:
        break;
    }
    return {};
}

/// Whether the shapes lie more than `margin` apart along `axis`.
bool apartAlong(const glm::dvec3& axis, const Polygon& a, const Polygon& b, double margin) {
    const double length = glm::length(axis);
    if (length == 0) return false;
    const auto span = [&](const Polygon& points) {
        glm::dvec2 range(HUGE_VAL, -HUGE_VAL);
        for (const glm::dvec3& p : points)
            range = {std::min(range.x, glm::dot(p, axis)), std::max(range.y, glm::dot(p, axis))};
        return range;
    };
    const glm::dvec2 spanA = span(a), spanB = span(b);
    return spanA.x - spanB.y > margin * length || spanB.x - spanA.y > margin * length;
}

/// Convex flat shapes meet unless an axis separates them: a normal, a product of two edges, or an edge's normal within its
/// plane.
bool touch(const Polygon& shape, const Polygon& triangle, double margin) {
    const auto edge = [](const Polygon& p, std::size_t i) { return p[(i + 1) % p.size()] - p[i]; };
    const auto normal = [](const Polygon& p) { return p.size() < 3 ? glm::dvec3(0) : glm::cross(p[1] - p[0], p[2] - p[0]); };
    const glm::dvec3 shapeNormal = normal(shape), triangleNormal = normal(triangle);
    if (apartAlong(shapeNormal, shape, triangle, margin) || apartAlong(triangleNormal, shape, triangle, margin))
        return false;
    for (std::size_t j = 0; j < triangle.size(); ++j)
        if (apartAlong(glm::cross(triangleNormal, edge(triangle, j)), shape, triangle, margin)) return false;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (apartAlong(glm::cross(shapeNormal, edge(shape, i)), shape, triangle, margin)) return false;
        if (apartAlong(glm::cross(triangleNormal, edge(shape, i)), shape, triangle, margin)) return false;
        for (std::size_t j = 0; j < triangle.size(); ++j)
            if (apartAlong(glm::cross(edge(shape, i), edge(triangle, j)), shape, triangle, margin)) return false;
    }
    return true;
}

bool overlap(const Bounds& a, const Bounds& b, double margin) {
    return glm::all(glm::lessThanEqual(a.low - margin, b.high)) && glm::all(glm::lessThanEqual(b.low - margin, a.high));
}

Bounds boundsOf(const Polygon& points) {
    Bounds box;
    for (const glm::dvec3& point : points) box.add(point);
    return box;
}

bool touches(const Polygon& shape, const Mesh& mesh, const glm::dmat4& world, double margin) {
    const Bounds box = boundsOf(shape);
    Polygon corners(3);
    for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            corners[static_cast<std::size_t>(i)] = glm::dvec3(world * glm::dvec4(glm::dvec3(mesh.positions[t[i]]), 1.0));
        if (overlap(box, boundsOf(corners), margin) && touch(shape, corners, margin)) return true;
    }
    return false;
}

/// Checks every placement of one frame; bounding boxes first, since a scene may have thousands.
std::optional<Problem> surfaceProblem(const Snapshot& frame) {
    constexpr double kRelative = 1e-9; // of the scene's extent: a distance that double arithmetic cannot distinguish from 0
    const Bounds all = frame.bounds();
    if (const auto id = surfaceAtLight(frame, kRelative * glm::distance(all.low, all.high)))
        return Problem{"light.centre",
                       fmt::format("the light lies on a surface (instance {}) at frame {}; move it off", *id, frame.frame)};
    const glm::dvec3& eye = frame.camera.eye;
    for (const Batch& batch : frame.batches) {
        if (!batch.mesh->closed) continue;
        const Bounds own = batch.mesh->bounds();
        for (const Placement& placement : batch.placements) {
            if (!overlap({eye, eye}, transformed(own, placement.world), 0)) continue;
            const glm::dvec3 local(glm::inverse(placement.world) * glm::dvec4(eye, 1.0));
            if (windingNumber(*batch.mesh, local) > 0.25)
                return Problem{"camera.eye",
                               fmt::format("the camera is inside a closed mesh (instance {}) at frame {}; move it out",
                                           placement.id, frame.frame)};
        }
    }
    return std::nullopt;
}

std::optional<Problem> walkProblem(Camera camera, const LodWalk& walk) {
    const glm::dvec3 eye = camera.eye, target = camera.target;
    for (int frame = 0; frame < walk.frames; ++frame) {
        camera.eye = walk.eye.at(frame, eye);
        camera.target = walk.target.at(frame, target);
        if (const auto problem = viewProblem(camera))
            return Problem{"lod.path", fmt::format("{} at frame {} of the walk", problem->sentence, frame)};
    }
    return std::nullopt;
}

} // namespace

std::optional<std::uint32_t> surfaceAtLight(const Snapshot& frame, double distance) {
    const Polygon shape = shapeOf(frame.light);
    if (shape.empty()) return std::nullopt;
    const Bounds lit = boundsOf(shape);
    for (const Batch& batch : frame.batches) {
        const Bounds own = batch.mesh->bounds();
        for (const Placement& placement : batch.placements)
            if (overlap(lit, transformed(own, placement.world), distance) &&
                touches(shape, *batch.mesh, placement.world, distance))
                return placement.id;
    }
    return std::nullopt;
}

std::optional<Problem> findProblem(const Scene& scene) {
    if (auto problem = sizeProblem(scene.light)) return problem;
    if (scene.light.kind == LightKind::Directional && !(glm::length(scene.light.direction) > 0))
        return Problem{"light.direction", "expected a vector other than zero"};
    const int lastStill = std::max(0, scene.timeline.still - 1); // the ones before it are the same
    for (int frame = -scene.timeline.approach; frame < scene.timeline.frames(); ++frame) {
        if (frame >= 0 && frame < lastStill) continue;
        const Snapshot now = snapshot(scene, frame);
        if (auto problem = reachProblem(now)) return problem;
        if (auto problem = viewProblem(now.camera)) return problem;
        if (auto problem = surfaceProblem(now)) return problem;
    }
    return scene.lod ? walkProblem(scene.camera, *scene.lod) : std::nullopt;
}

void requireWellPosed(const Scene& scene) {
    if (const auto problem = findProblem(scene))
        throw BadInput(fmt::format("{}: {}: {}", scene.id, problem->key, problem->sentence));
}

} // namespace shadowbench
