#include "groundtruth/cgal/hard/samples.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/rays.h"

namespace shadowbench::groundtruth::hard {
namespace {

struct Seen {
    std::uint32_t points = 0, undecided = 0;
};

Seen seenFrom(const SceneTriangles& scene, const ReceiverPoint& point, TriangleName receiver,
              std::span<const glm::dvec3> lights) {
    Seen seen;
    for (const glm::dvec3& light : lights) {
        const Blocking found = shadowLabel(scene, point, receiver, glm::dvec4(light, 1));
        if (found != Blocking::Blocks) ++seen.points;
        if (found == Blocking::Touches) ++seen.undecided;
    }
    return seen;
}

} // namespace

SampledVisibility visibleShare(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary,
                               std::span<const glm::dvec3> lights, int threads, const Progress& progress) {
    if (lights.empty()) throw InternalError("The visible share of no light points was asked for.");
    if (primary.id.width() != size.x || primary.id.height() != size.y)
        throw InternalError("The visible share was asked for an image size that is not that of the primary hits.");
    const SceneTriangles scene(snapshot);
    SampledVisibility result{Image<float>(size.x, size.y, 0), Image<std::uint32_t>(size.x, size.y, 0)};
    inParallel(size.y, threads, progress, "light samples", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != Surface::Receiver) continue;
            const TriangleName receiver{scene.instanceOf(primary.id(x, y)), primary.triangle(x, y)};
            const ReceiverPoint point(pixelRay(snapshot.camera, x, y, size), scene.triangle(receiver));
            const Seen seen = seenFrom(scene, point, receiver, lights);
            result.share(x, y) = static_cast<float>(seen.points) / static_cast<float>(lights.size());
            result.undecided(x, y) = seen.undecided;
        }
    });
    return result;
}

} // namespace shadowbench::groundtruth::hard
