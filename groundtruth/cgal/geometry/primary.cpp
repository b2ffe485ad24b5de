#include "groundtruth/cgal/geometry/primary.h"

#include "base/parallel.h"

#include <algorithm>
#include <optional>

namespace shadowbench::groundtruth::geometry {
namespace {

struct Hit {
    TriangleName name;
    std::uint32_t id;
    Triangle triangle;
    DepthBounds depth;
};

/// Does the ray meet the plane of `a` first? Ties go to the lower surface id, then to the lower triangle index.
bool before(const Ray& ray, const Hit& a, const Hit& b) {
    if (a.depth.high < b.depth.low) return true;
    if (b.depth.high < a.depth.low) return false;
    const int order = compareDepth(ray, a.triangle, b.triangle);
    if (order != 0) return order < 0;
    if (a.id != b.id) return a.id < b.id;
    return a.name.triangle < b.name.triangle;
}

bool inView(const Camera& camera, const Ray& ray, const Hit& hit) {
    const bool surelyIn = hit.depth.low >= camera.near && hit.depth.high <= camera.far;
    return surelyIn ||
           (compareDepth(ray, hit.triangle, camera.near) >= 0 && compareDepth(ray, hit.triangle, camera.far) <= 0);
}

std::optional<Hit> nearest(const SceneTriangles& scene, const Camera& camera, const Ray& ray) {
    const ApproximateSegment segment{ray.origin, ray.origin + camera.far * ray.direction, glm::dvec3(0)};
    std::optional<Hit> best;
    scene.visit(segment, [&](TriangleName name, double& last) {
        const Triangle triangle = scene.triangle(name);
        const std::optional<DepthBounds> depth = crossing(ray, triangle);
        if (!depth) return false;
        const Hit hit{name, scene.instances()[name.instance].id, triangle, *depth};
        if (!inView(camera, ray, hit) || (best && !before(ray, hit, *best))) return false;
        best = hit;
        last = std::min(last, depth->high / camera.far * (1 + 0x1p-50));
        return false;
    });
    return best;
}

/// Homogeneous points that all must lie strictly on the eye's side for a surface to be a receiver. None of an environment,
/// which is on all sides.
std::vector<glm::dvec4> lightCorners(const Light& light) {
    if (light.isEnvironment()) return {};
    if (!light.isArea()) return {light.homogeneous()};
    if (light.kind == LightKind::Line)
        return {glm::dvec4(light.centre - 0.5 * light.u, 1), glm::dvec4(light.centre + 0.5 * light.u, 1)};
    std::vector<glm::dvec4> corners;
    for (const double s : {-0.5, 0.5})
        for (const double t : {-0.5, 0.5}) corners.emplace_back(light.centre + s * light.u + t * light.v, 1);
    return corners;
}

Surface classify(const Triangle& triangle, const glm::dvec3& eye, const std::vector<glm::dvec4>& light) {
    const int eyeSide = side(triangle, glm::dvec4(eye, 1));
    const bool faces =
        std::ranges::all_of(light, [&](const glm::dvec4& corner) { return side(triangle, corner) == eyeSide; });
    return faces ? Surface::Receiver : Surface::FacesAway;
}

} // namespace

Ray pixelRay(const Camera& camera, int x, int y, glm::ivec2 size) { return pixelRay(CameraRays(camera, size), x, y); }

Ray pixelRay(const CameraRays& rays, int x, int y) { return {rays.eye(), rays.at({x + 0.5, y + 0.5})}; }

std::optional<SeenPoint> seenAlong(const SceneTriangles& scene, const Camera& camera, const Light& light, const Ray& ray) {
    const std::optional<Hit> hit = nearest(scene, camera, ray);
    if (!hit) return std::nullopt;
    return SeenPoint{hit->name, classify(hit->triangle, camera.eye, lightCorners(light))};
}

PrimaryHits tracePrimary(const SceneTriangles& scene, const Camera& camera, const Light& light, glm::ivec2 size, int threads,
                         const Progress& progress) {
    PrimaryHits hits{Image<std::uint32_t>(size.x, size.y), Image<glm::vec3>(size.x, size.y, glm::vec3(0)),
                     Image<Surface>(size.x, size.y, Surface::Background), Image<std::uint32_t>(size.x, size.y)};
    const std::vector<glm::dvec4> corners = lightCorners(light);
    const CameraRays rays(camera, size);
    inParallel(size.y, threads, progress, "primary hits", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            const Ray ray = pixelRay(rays, x, y);
            const std::optional<Hit> hit = nearest(scene, camera, ray);
            if (!hit) continue;
            hits.id(x, y) = hit->id;
            hits.triangle(x, y) = hit->name.triangle;
            hits.position(x, y) = glm::vec3(ray.origin + 0.5 * (hit->depth.low + hit->depth.high) * ray.direction);
            hits.surface(x, y) = classify(hit->triangle, camera.eye, corners);
        }
    });
    return hits;
}

} // namespace shadowbench::groundtruth::geometry
