#include "studies/recommend/shadows.h"

#include "base/parallel.h"
#include "groundtruth/cgal/area/area.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/povray/povray.h"

#include <algorithm>
#include <fmt/format.h>
#include <mutex>
#include <utility>

namespace shadowbench::recommend {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;
using groundtruth::hard::EdgeDistances;
using groundtruth::hard::ExactScene;
using groundtruth::hard::PlanarReceiver;

Shadow shadowOf(const Reference& labels) {
    Shadow shadow{labels.visibility, Image<std::uint8_t>(labels.surface.width(), labels.surface.height())};
    std::ranges::transform(labels.surface, shadow.labelled.begin(),
                           [](Surface surface) { return static_cast<std::uint8_t>(surface == Surface::Receiver); });
    return shadow;
}

Reference byRays(const Snapshot& casters, const Receivers& receivers) {
    Reference labels;
    ExactScene(casters, availableThreads()).labelByRays(receivers.size, receivers.primary, labels);
    return labels;
}

Reference byPolygons(const Snapshot& casters, const Receivers& receivers) {
    const ExactScene scene(casters, 1);
    const std::vector<PlanarReceiver> planes = scene.planarReceivers(receivers.primary);
    std::size_t planar = 0;
    for (const PlanarReceiver& plane : planes) planar += plane.pixels;
    Reference labels;
    if (planar < receivers.pixels) scene.labelByRays(receivers.size, receivers.primary, labels);
    for (const PlanarReceiver& plane : planes)
        scene.labelByPolygon(receivers.size, receivers.primary, plane, labels, {}, EdgeDistances::NotWanted);
    return labels;
}

/// The casters in parts of at most `mostTriangles`, or one instance where that has more; each part has all receivers too.
std::vector<Snapshot> parts(const Snapshot& casters, const Receivers& receivers, std::size_t mostTriangles) {
    Snapshot receiving = casters;
    for (Batch& batch : receiving.batches)
        std::erase_if(batch.placements, [&](const Placement& placement) { return !receivers.ids.contains(placement.id); });

    std::vector<Snapshot> result{receiving};
    std::size_t triangles = 0; // of the last part, without the receivers
    for (const Batch& batch : casters.batches) {
        const std::size_t more = batch.mesh->triangles.size();
        result.back().batches.push_back({batch.mesh, batch.colour, batch.moving, {}});
        for (const Placement& placement : batch.placements) {
            if (receivers.ids.contains(placement.id)) continue;
            if (triangles > 0 && triangles + more > mostTriangles) {
                result.push_back(receiving);
                result.back().batches.push_back({batch.mesh, batch.colour, batch.moving, {}});
                triangles = 0;
            }
            result.back().batches.back().placements.push_back(placement);
            triangles += more;
        }
    }
    return result;
}

Shadow joined(const Shadow& a, const Shadow& b) {
    Shadow both = a;
    for (std::size_t i = 0; i < both.labelled.size(); ++i) {
        both.visibility[i] = std::min(a.visibility[i], b.visibility[i]);
        both.labelled[i] = a.labelled[i] & b.labelled[i];
    }
    return both;
}

} // namespace

ShadowOracle polygonOracle(const Receivers& receivers, std::size_t mostTriangles) {
    return {"polygon", [&receivers, mostTriangles](const Snapshot& casters) {
                const std::vector<Snapshot> all = parts(casters, receivers, mostTriangles);
                Shadow shadow;
                std::mutex one;
                inParallel(static_cast<int>(all.size()), availableThreads(), [&](int i) {
                    Shadow part = shadowOf(byPolygons(all[static_cast<std::size_t>(i)], receivers));
                    const std::scoped_lock lock(one);
                    shadow = shadow.labelled.empty() ? std::move(part) : joined(shadow, part);
                });
                return shadow;
            }};
}

ShadowOracle rayOracle(const Receivers& receivers) {
    return {"rays", [&receivers](const Snapshot& casters) { return shadowOf(byRays(casters, receivers)); }};
}

ShadowOracle areaOracle(const Receivers& receivers) {
    return {
        "area", [&receivers](const Snapshot& casters) {
            Reference fractions;
            groundtruth::area::AreaScene(casters, availableThreads()).label(receivers.size, receivers.primary, fractions);
            return shadowOf(fractions);
        }};
}

ShadowOracle sampledOracle(const Receivers& receivers, int samples) {
    return {fmt::format("rays from {} points of the light", samples), [&receivers, samples](Snapshot casters) {
                const Light area = casters.light;
                Shadow mean{Image<float>(receivers.size.x, receivers.size.y),
                            Image<std::uint8_t>(receivers.size.x, receivers.size.y, 1)};
                for (int i = 0; i < samples; ++i) {
                    casters.light = area.centreOnly();
                    casters.light.centre = area.sample(groundtruth::povray::lightSample(i, samples));
                    const Shadow one = shadowOf(byRays(casters, receivers));
                    for (std::size_t pixel = 0; pixel < one.labelled.size(); ++pixel) {
                        mean.visibility[pixel] += one.visibility[pixel];
                        mean.labelled[pixel] &= one.labelled[pixel];
                    }
                }
                for (float& visible : mean.visibility) visible /= static_cast<float>(samples);
                return mean;
            }};
}

} // namespace shadowbench::recommend
