#include "groundtruth/cgal/hard/rays.h"

#include "base/parallel.h"
#include "groundtruth/cgal/geometry/primary.h"

#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::hard {
namespace {

/// The part of the way to the light on which the scene can lie.
ApproximateSegment towardsLight(const SceneTriangles& scene, const ReceiverPoint& point, const glm::dvec4& light) {
    const glm::dvec3& from = point.near();
    const glm::dvec3 l(light);
    const double reach = scene.reachFrom(from) / glm::length(l);
    return {from, light.w == 0 ? from + reach * l : l, point.nearError()};
}

} // namespace

Blocking shadowLabel(const SceneTriangles& scene, const ReceiverPoint& point, TriangleName receiver,
                     const glm::dvec4& light) {
    std::vector<Triangle> touching;
    const bool blocked = scene.visit(towardsLight(scene, point, light), [&](TriangleName name, double&) {
        if (name == receiver) return false;
        const Triangle triangle = scene.triangle(name);
        const Blocking found = blocking(point, light, triangle);
        if (found == Blocking::Touches) touching.push_back(triangle);
        return found == Blocking::Blocks;
    });
    if (blocked || blockTogether(point, light, touching)) return Blocking::Blocks;
    return touching.empty() ? Blocking::None : Blocking::Touches;
}

std::optional<int> coverCount(const SceneTriangles& scene, const ReceiverPoint& point, TriangleName receiver,
                              const glm::dvec4& light) {
    int count = 0;
    const bool touched = scene.visit(towardsLight(scene, point, light), [&](TriangleName name, double&) {
        if (name == receiver) return false;
        const Triangle triangle = scene.triangle(name);
        const Blocking found = blocking(point, light, triangle);
        count += found == Blocking::Blocks;
        return found == Blocking::Touches;
    });
    return touched ? std::nullopt : std::optional(count);
}

void traceShadows(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                  const PrimaryHits& primary, int threads, Reference& out, const Progress& progress) {
    const CameraRays rays(camera, size);
    inParallel(size.y, threads, progress, "shadow rays", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != Surface::Receiver) continue;
            const TriangleName receiver{scene.instanceOf(primary.id(x, y)), primary.triangle(x, y)};
            const ReceiverPoint point(pixelRay(rays, x, y), scene.triangle(receiver));
            const Blocking found = shadowLabel(scene, point, receiver, light);
            out.visibility(x, y) = found == Blocking::Blocks ? 0.0F : 1.0F;
            out.surface(x, y) = found == Blocking::Touches ? Surface::OnEdge : Surface::Receiver;
        }
    });
}

} // namespace shadowbench::groundtruth::hard
