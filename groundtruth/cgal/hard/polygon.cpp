// Silhouette chains → edges in pixels → winding numbers → labels; then the distance to where the winding number becomes
// zero. No tree and no shadow ray has a part in it.
#include "groundtruth/cgal/hard/polygon.h"

#include "base/parallel.h"
#include "groundtruth/cgal/hard/edge_distance.h"
#include "groundtruth/cgal/hard/plane_winding.h"

#include <algorithm>
#include <limits>

namespace shadowbench::groundtruth::hard {
namespace {

/// The pixels that see the receiver.
Image<std::uint8_t> membersOf(const PlanarReceiver& receiver, const PrimaryHits& primary) {
    Image<std::uint8_t> members(primary.id.width(), primary.id.height());
    std::uint32_t last = receiver.triangles.front(); // neighbours mostly see the same triangle
    bool lastBelongs = true;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (primary.surface[i] != Surface::Receiver || primary.id[i] != receiver.id) continue;
        if (primary.triangle[i] != last) {
            last = primary.triangle[i];
            lastBelongs = std::ranges::binary_search(receiver.triangles, last);
        }
        members[i] = lastBelongs;
    }
    return members;
}

std::vector<PixelEdge> inPixels(const Casters& casters, const ShadowProjection& projection, glm::ivec2 size, int threads) {
    constexpr std::size_t most = 1U << 13U;
    std::vector<std::vector<PixelEdge>> parts((casters.edges() + most - 1) / most);
    inParallel(static_cast<int>(parts.size()), threads, [&](int i) {
        std::vector<PixelEdge>& edges = parts[i];
        const std::size_t begin = most * static_cast<std::size_t>(i), end = std::min(begin + most, casters.edges());
        casters.forEachEdge(begin, end, [&](std::size_t index, const CastEdge& cast) {
            if (cast.edge.atLightLevel || missesImage(cast.instance, cast.edge, projection)) return;
            if (const auto edge = toPixels(shadowEdge(cast.instance, cast.edge, projection), size, projection.pixelError(),
                                           static_cast<std::uint32_t>(index)))
                edges.push_back(*edge);
        });
    });
    std::vector<PixelEdge> edges;
    for (const std::vector<PixelEdge>& part : parts) edges.insert(edges.end(), part.begin(), part.end());
    return edges;
}

} // namespace

void labelPlane(const Occluders& occluders, const Camera& camera, glm::ivec2 size, const PrimaryHits& primary,
                const PlanarReceiver& receiver, EdgeDistances distances, Reference& out, const Progress& progress) {
    const Image<std::uint8_t> members = membersOf(receiver, primary);
    const SceneTriangles& scene = occluders.scene();
    const PlaneView view{camera, size, scene.triangle({scene.instanceOf(receiver.id), receiver.triangles.front()}), members};
    const ShadowProjection projection(view.plane, occluders.light(), camera, size);
    const Casters casters = occluders.castersOnto(projection, progress);
    const std::vector<PixelEdge> edges = inPixels(casters, projection, size, occluders.threads());
    const PlaneWinding winding(view, occluders, casters, edges);

    inParallel(size.y, occluders.threads(), progress, "labels", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            if (!members(x, y)) continue;
            const auto [lowest, highest] = winding.at(x, y);
            const bool onEdge = lowest == 0 && highest > 0;
            out.visibility(x, y) = lowest > 0 ? 0.0F : 1.0F;
            out.surface(x, y) = onEdge ? Surface::OnEdge : Surface::Receiver;
            out.edgeDistance(x, y) = onEdge ? 0.0F : std::numeric_limits<float>::infinity();
        }
    });
    if (distances == EdgeDistances::Wanted)
        lowerToEdgeDistance(edges, winding, members, occluders.threads(), out.edgeDistance);
}

} // namespace shadowbench::groundtruth::hard
