#include "techniques/soft/convolution/clusters.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace shadowbench::techniques {
namespace {

using Polygons = std::vector<BlockerPolygon>;
using Members = std::vector<std::size_t>;
using Triangle = std::array<glm::dvec3, 3>;

void extend(BlockerDepths& range, const BlockerDepths& by) {
    range.near = std::min(range.near, by.near);
    range.far = std::max(range.far, by.far);
}

BlockerDepths rangeOf(const Members& members, const Polygons& polygons) {
    BlockerDepths range = polygons[members.front()].depths;
    for (const std::size_t i : members) extend(range, polygons[i].depths);
    return range;
}

/// The depth behind the widest gap that the cluster's surfaces leave, each with all its polygons.
std::optional<double> behindWidestGap(const Cluster& cluster, const Polygons& polygons) {
    std::map<std::uint32_t, BlockerDepths> ofSurface;
    for (const std::size_t i : cluster.members)
        extend(ofSurface.try_emplace(polygons[i].surface, polygons[i].depths).first->second, polygons[i].depths);
    std::vector<BlockerDepths> ranges;
    for (const auto& [surface, range] : ofSurface) ranges.push_back(range);
    std::ranges::sort(ranges, {}, &BlockerDepths::near);

    std::optional<double> behind;
    double widest = 0, farthest = ranges.front().far;
    for (const BlockerDepths& range : ranges) {
        const double gap = 1 / farthest - 1 / range.near;
        if (gap > widest) {
            widest = gap;
            behind = range.near;
        }
        farthest = std::max(farthest, range.far);
    }
    return behind;
}

/// Takes the members for which `isBehind` holds out of the cluster; nothing if they are all or none.
template <typename IsBehind>
std::optional<Cluster> splitOff(Cluster& cluster, const Polygons& polygons, const IsBehind& isBehind) {
    Members& members = cluster.members;
    const auto cut = std::ranges::stable_partition(members, [&](std::size_t i) { return !isBehind(polygons[i].depths); });
    if (cut.begin() == members.begin() || cut.empty()) return {};
    Cluster behind{Members(cut.begin(), cut.end()), {}, cluster.group};
    members.erase(cut.begin(), cut.end());
    cluster.range = rangeOf(members, polygons);
    behind.range = rangeOf(behind.members, polygons);
    return behind;
}

/// The clusters as they are split.
class Subdivision {
public:
    explicit Subdivision(const Polygons& polygons) : polygons_(polygons) {
        Members all(polygons.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        add({all, rangeOf(all, polygons), 0});
    }

    [[nodiscard]] std::size_t count() const { return clusters_.size(); }

    /// Splits the widest cluster that can be and spreads more than `tolerance`; false: there is none.
    bool splitWidest(double tolerance) {
        while (true) {
            std::size_t widest = 0;
            for (std::size_t i = 1; i < clusters_.size(); ++i)
                if (spreadToSplit(i) > spreadToSplit(widest)) widest = i;
            if (spreadToSplit(widest) <= tolerance) return false;
            if (split(widest)) return true;
            isWhole_[widest] = true;
        }
    }

    std::vector<Cluster> take() {
        std::ranges::stable_sort(clusters_, {}, [](const Cluster& cluster) { return cluster.group; });
        return std::move(clusters_);
    }

private:
    void add(Cluster cluster) {
        clusters_.push_back(std::move(cluster));
        isWhole_.push_back(false);
    }

    [[nodiscard]] double spreadToSplit(std::size_t i) const { return isWhole_[i] ? 0 : clusters_[i].range.spread(); }

    bool split(std::size_t i) {
        std::optional<Cluster> behind = splitGroup(clusters_[i]);
        if (!behind) {
            const double middle = clusters_[i].range.middle();
            behind =
                splitOff(clusters_[i], polygons_, [&](const BlockerDepths& depths) { return depths.middle() > middle; });
        }
        if (behind) add(std::move(*behind));
        return behind.has_value();
    }

    /// What lies behind a gap becomes a group of its own, as long as the group is one cluster.
    std::optional<Cluster> splitGroup(Cluster& cluster) {
        if (std::ranges::count(clusters_, cluster.group, &Cluster::group) > 1) return {};
        const std::optional<double> from = behindWidestGap(cluster, polygons_);
        if (!from) return {};
        std::optional<Cluster> behind =
            splitOff(cluster, polygons_, [&](const BlockerDepths& depths) { return depths.near >= *from; });
        behind->group = groups_++;
        return behind;
    }

    const Polygons& polygons_;
    std::vector<Cluster> clusters_;
    std::vector<bool> isWhole_; // that cluster cannot be split
    std::size_t groups_ = 1;
};

/// Held in front of the view's near plane.
BlockerDepths depthsOf(const Triangle& triangle, const LightView& view) {
    BlockerDepths range{view.far, view.near};
    for (const glm::dvec3& corner : triangle) {
        const double depth = std::max(glm::dot(view.depthFromWorld, glm::dvec4(corner, 1)), view.near);
        extend(range, {depth, depth});
    }
    return range;
}

bool facesLight(const Triangle& t, const Light& light) {
    const glm::dvec4 from = light.homogeneous();
    return glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), glm::dvec3(from) - from.w * t[0]) > 0;
}

} // namespace

Polygons blockerPolygons(const Snapshot& snapshot, const LightView& view, const std::vector<bool>& shown) {
    Polygons polygons;
    std::size_t number = 0;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) {
            if (!shown[number++]) continue;
            const Mesh& mesh = *batch.mesh;
            const bool isMirrored = glm::determinant(glm::dmat3(placement.world)) < 0;
            std::vector<glm::dvec3> corners;
            for (const glm::vec3& p : mesh.positions) corners.emplace_back(placement.world * glm::dvec4(p, 1));
            for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
                const glm::uvec3& t = mesh.triangles[i];
                const Triangle triangle{corners[t.x], corners[t.y], corners[t.z]};
                if (mesh.closed && facesLight(triangle, snapshot.light) == isMirrored) continue;
                polygons.push_back({depthsOf(triangle, view), placement.id, i});
            }
        }
    return polygons;
}

std::vector<Cluster> clustered(const Polygons& polygons, double tolerance, std::size_t most) {
    if (polygons.empty()) return {};
    Subdivision subdivision(polygons);
    while (subdivision.count() < most && subdivision.splitWidest(tolerance)) {
    }
    return subdivision.take();
}

} // namespace shadowbench::techniques
