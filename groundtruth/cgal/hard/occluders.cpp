#include "groundtruth/cgal/hard/occluders.h"

#include "base/parallel.h"
#include "groundtruth/cgal/hard/scanline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr std::size_t large = 1U << 16U; // triangles from which the threads share one instance

using Corners = std::array<glm::dvec3, 8>;

Corners cornersOf(const FloatBox& box) {
    const Bounds bounds{glm::dvec3(box.low), glm::dvec3(box.high)};
    return bounds.corners();
}

/// Do shadows of what lies in the box surely miss the image? A linear function of the image position that is negative at all
/// corners is negative in the box.
bool missesImage(const Corners& corners, const ShadowProjection& projection, glm::ivec2 size) {
    const double margin = scanMargin + 2;
    std::array<bool, 4> beyond{true, true, true, true};
    for (const glm::dvec3& corner : corners) {
        const auto [p, error, lightSide] = projection.project(corner);
        for (int axis = 0; axis < 2; ++axis) {
            const double high = size[axis] + margin;
            const double slack = 2 * (error[axis] + high * error.z + 0x1p-50 * (std::abs(p[axis]) + high * std::abs(p.z)));
            beyond[2 * axis] &= p[axis] + margin * p.z + slack < 0;
            beyond[2 * axis + 1] &= high * p.z - p[axis] + slack < 0;
        }
    }
    return std::ranges::any_of(beyond, [](bool b) { return b; });
}

} // namespace

Occluders::Occluders(const SceneTriangles& scene, const glm::dvec4& light, int threads)
    : scene_(scene), light_(light), threads_(threads), edges_(scene.meshes()), whole_(scene.instances().size()) {}

const MeshEdges& Occluders::edgesOf(const TriangleInstance& instance) const {
    Edges& entry = edges_[instance.tree];
    std::call_once(entry.found, [&] { entry.edges = MeshEdges(*instance.mesh); });
    return entry.edges;
}

std::shared_ptr<const Chains> Occluders::chainsOf(std::size_t index, const ShadowProjection& projection, glm::ivec2 size,
                                                  int threads) const {
    const TriangleInstance& instance = scene_.instances()[index];
    const Corners corners = cornersOf(instance.box);
    std::array<int, 8> heights{}, levels{};
    std::ranges::transform(corners, heights.begin(), [&](const auto& c) { return projection.height(c); });
    if (std::ranges::max(heights) <= 0) return nullptr;
    std::ranges::transform(corners, levels.begin(),
                           [&](const auto& c) { return belowLight(projection.receiver(), light_, c); });
    if (std::ranges::max(levels) <= 0 || missesImage(corners, projection, size)) return nullptr;

    if (std::ranges::min(heights) <= 0 || std::ranges::min(levels) <= 0)
        return std::make_shared<Chains>(clippedChains(instance, edgesOf(instance), light_, projection.receiver(), threads));
    Whole& whole = whole_[index];
    std::call_once(whole.made, [&] {
        whole.chains = std::make_shared<Chains>(wholeChains(instance, edgesOf(instance), light_, threads));
    });
    return whole.chains;
}

Casters Occluders::castersOnto(const ShadowProjection& projection, glm::ivec2 size, const Progress& progress) const {
    const std::size_t count = scene_.instances().size();
    std::vector<std::shared_ptr<const Chains>> chains(count);
    const auto trianglesOf = [&](std::size_t i) { return scene_.instances()[i].mesh->triangles.size(); };
    const auto isLarge = [&](std::size_t i) { return trianglesOf(i) >= large; };
    std::size_t others = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (isLarge(i))
            chains[i] = chainsOf(i, projection, size, threads_);
        else
            others += trianglesOf(i);
    }
    inParallel(static_cast<int>(count), others < large ? 1 : threads_, progress, "silhouettes", [&](int i) {
        if (!isLarge(i)) chains[i] = chainsOf(i, projection, size, 1);
    });

    Casters casters;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!chains[i]) continue;
        for (const ChainEdge& edge : chains[i]->edges) casters.edges.push_back({i, edge});
        for (const std::uint32_t triangle : chains[i]->grounded) casters.grounded.push_back({i, triangle});
    }
    return casters;
}

} // namespace shadowbench::groundtruth::hard
