#include "groundtruth/cgal/hard/occluders.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr std::size_t large = 1U << 16U; // triangles from which the threads share one instance

} // namespace

Casters::Casters(const SceneTriangles& scene, std::vector<std::shared_ptr<const Chains>> chains)
    : scene_(scene), chains_(std::move(chains)), first_{0} {
    for (std::uint32_t i = 0; i < chains_.size(); ++i) {
        first_.push_back(first_.back() + (chains_[i] ? chains_[i]->edges.size() : 0));
        if (!chains_[i]) continue;
        for (const std::uint32_t triangle : chains_[i]->grounded) grounded_.push_back({i, triangle});
    }
}

std::size_t Casters::instanceOf(std::size_t edge) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(first_, edge) - first_.begin()) - 1;
}

CastEdge Casters::edge(std::size_t index) const {
    const std::size_t i = instanceOf(index);
    return {scene_.instances()[i], chains_[i]->edges[index - first_[i]]};
}

Occluders::Occluders(const SceneTriangles& scene, const glm::dvec4& light, int threads)
    : scene_(scene), light_(light), threads_(threads), edges_(scene.meshes()), whole_(scene.instances().size()) {}

const MeshEdges& Occluders::edgesOf(const TriangleInstance& instance) const {
    Edges& entry = edges_[instance.tree];
    std::call_once(entry.found, [&] { entry.edges = MeshEdges(*instance.mesh); });
    return entry.edges;
}

std::shared_ptr<const Chains> Occluders::chainsOf(std::size_t index, const ShadowProjection& projection, int threads) const {
    const TriangleInstance& instance = scene_.instances()[index];
    const auto corners = Bounds{glm::dvec3(instance.box.low), glm::dvec3(instance.box.high)}.corners();
    std::array<int, 8> heights{}, levels{};
    std::ranges::transform(corners, heights.begin(), [&](const auto& c) { return projection.height(c); });
    if (std::ranges::max(heights) <= 0) return nullptr;
    std::ranges::transform(corners, levels.begin(),
                           [&](const auto& c) { return belowLight(projection.receiver(), light_, c); });
    if (std::ranges::max(levels) <= 0 || projection.misses(corners)) return nullptr;

    if (std::ranges::min(heights) <= 0 || std::ranges::min(levels) <= 0)
        return std::make_shared<Chains>(clippedChains(instance, edgesOf(instance), light_, projection.receiver(), threads));
    Whole& whole = whole_[index];
    std::call_once(whole.made, [&] {
        whole.chains = std::make_shared<Chains>(wholeChains(instance, edgesOf(instance), light_, threads));
    });
    return whole.chains;
}

Casters Occluders::castersOnto(const ShadowProjection& projection, const Progress& progress) const {
    const std::size_t count = scene_.instances().size();
    std::vector<std::shared_ptr<const Chains>> chains(count);
    const auto trianglesOf = [&](std::size_t i) { return scene_.instances()[i].mesh->triangles.size(); };
    const auto isLarge = [&](std::size_t i) { return trianglesOf(i) >= large; };
    std::size_t others = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (isLarge(i))
            chains[i] = chainsOf(i, projection, threads_);
        else
            others += trianglesOf(i);
    }
    inParallel(static_cast<int>(count), others < large ? 1 : threads_, progress, "silhouettes", [&](int i) {
        if (!isLarge(i)) chains[i] = chainsOf(i, projection, 1);
    });

    return {scene_, std::move(chains)};
}

} // namespace shadowbench::groundtruth::hard
