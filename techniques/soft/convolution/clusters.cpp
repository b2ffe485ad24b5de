#include "techniques/soft/convolution/clusters.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>
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

/// Of the cluster's surfaces, each with all its polygons.
std::map<std::uint32_t, BlockerDepths> surfaceRanges(const Cluster& cluster, const Polygons& polygons) {
    std::map<std::uint32_t, BlockerDepths> ranges;
    for (const std::size_t i : cluster.members)
        extend(ranges.try_emplace(polygons[i].surface, polygons[i].depths).first->second, polygons[i].depths);
    return ranges;
}

/// The depth behind the widest gap that the cluster's surfaces leave.
std::optional<double> behindWidestGap(const Cluster& cluster, const Polygons& polygons) {
    std::vector<BlockerDepths> ranges;
    for (const auto& [surface, range] : surfaceRanges(cluster, polygons)) ranges.push_back(range);
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

/// Surfaces with a polygon that spreads more than half as much as the cluster.
std::set<std::uint32_t> elongatedSurfaces(const Cluster& cluster, const Polygons& polygons) {
    std::set<std::uint32_t> surfaces;
    for (const std::size_t i : cluster.members)
        if (polygons[i].depths.spread() > 0.5 * cluster.range.spread()) surfaces.insert(polygons[i].surface);
    return surfaces;
}

/// What a split has to gain: nothing, a part that spreads clearly less than the whole, or two such parts.
enum class Gain { None, OnePart, BothParts };

/// Takes the members for which `isApart` holds out of the cluster; nothing if they are all or none, or without the gain.
template <typename IsApart>
std::optional<Cluster> splitOff(Cluster& cluster, const Polygons& polygons, Gain gain, const IsApart& isApart) {
    Members& members = cluster.members;
    const auto cut = std::ranges::stable_partition(members, [&](std::size_t i) { return !isApart(polygons[i]); });
    if (cut.begin() == members.begin() || cut.empty()) return {};
    const Members left(members.begin(), cut.begin()), taken(cut.begin(), cut.end());
    const BlockerDepths leftRange = rangeOf(left, polygons), takenRange = rangeOf(taken, polygons);
    const auto [less, more] = std::minmax({leftRange.spread(), takenRange.spread()});
    const double clearlyLess = 0.75 * cluster.range.spread();
    if (gain != Gain::None && (gain == Gain::OnePart ? less : more) > clearlyLess) return {};
    cluster = {left, leftRange, cluster.group};
    return Cluster{taken, takenRange, cluster.group};
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
        Cluster& cluster = clusters_[i];
        const bool isGroup = std::ranges::count(clusters_, cluster.group, &Cluster::group) == 1;
        std::optional<Cluster> apart;
        if (isGroup) apart = ofNewGroup(splitAtGap(cluster));
        if (!apart && isGroup) apart = ofNewGroup(splitSurfaces(cluster));
        if (!apart) apart = splitPolygons(cluster);
        if (!apart && isGroup) apart = ofNewGroup(splitElongated(cluster));
        if (apart) add(std::move(*apart));
        return apart.has_value();
    }

    std::optional<Cluster> ofNewGroup(std::optional<Cluster> cluster) {
        if (cluster) cluster->group = groups_++;
        return cluster;
    }

    [[nodiscard]] std::optional<Cluster> splitAtGap(Cluster& cluster) const {
        const std::optional<double> from = behindWidestGap(cluster, polygons_);
        if (!from) return {};
        return splitOff(cluster, polygons_, Gain::None, [&](const BlockerPolygon& p) { return p.depths.near >= *from; });
    }

    /// In the middle of the depths, whole surfaces.
    [[nodiscard]] std::optional<Cluster> splitSurfaces(Cluster& cluster) const {
        const double middle = cluster.range.middle();
        const std::map<std::uint32_t, BlockerDepths> ranges = surfaceRanges(cluster, polygons_);
        return splitOff(cluster, polygons_, Gain::OnePart,
                        [&](const BlockerPolygon& p) { return ranges.at(p.surface).middle() > middle; });
    }

    /// Light leaks between parts of a surface whose planes lie far apart, so both have to gain.
    [[nodiscard]] std::optional<Cluster> splitPolygons(Cluster& cluster) const {
        const double middle = cluster.range.middle();
        return splitOff(cluster, polygons_, Gain::BothParts,
                        [&](const BlockerPolygon& p) { return p.depths.middle() > middle; });
    }

    [[nodiscard]] std::optional<Cluster> splitElongated(Cluster& cluster) const {
        const std::set<std::uint32_t> elongated = elongatedSurfaces(cluster, polygons_);
        return splitOff(cluster, polygons_, Gain::None,
                        [&](const BlockerPolygon& p) { return elongated.contains(p.surface); });
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
