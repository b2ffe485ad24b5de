#include "techniques/soft/convolution/clusters.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace shadowbench::techniques {
namespace {

/// Blockers by their numbers, ascending by the middles of their depths.
using Members = std::vector<std::size_t>;

BlockerDepths rangeOf(const Members& members, const std::vector<BlockerDepths>& blockers) {
    BlockerDepths range = blockers[members.front()];
    for (const std::size_t i : members) {
        range.near = std::min(range.near, blockers[i].near);
        range.far = std::max(range.far, blockers[i].far);
    }
    return range;
}

/// Takes what lies behind the widest gap out of `members`, which are several.
Members splitOff(Members& members, const std::vector<BlockerDepths>& blockers) {
    std::size_t cut = 1;
    double widest = -1;
    for (std::size_t i = 1; i < members.size(); ++i) {
        const double gap = 1 / blockers[members[i - 1]].middle() - 1 / blockers[members[i]].middle();
        if (gap <= widest) continue;
        widest = gap;
        cut = i;
    }
    Members behind(members.begin() + static_cast<std::ptrdiff_t>(cut), members.end());
    members.resize(cut);
    return behind;
}

} // namespace

Clusters clustered(const std::vector<BlockerDepths>& blockers, double tolerance, int most) {
    if (blockers.empty()) return {};
    std::vector<Members> clusters(1, Members(blockers.size()));
    std::iota(clusters[0].begin(), clusters[0].end(), std::size_t{0});
    std::ranges::stable_sort(clusters[0], {}, [&](std::size_t i) { return blockers[i].middle(); });

    const auto spreadToSplit = [&](const Members& members) {
        return members.size() > 1 ? rangeOf(members, blockers).spread() : 0;
    };
    while (clusters.size() < static_cast<std::size_t>(most)) {
        const auto widest = std::ranges::max_element(clusters, {}, spreadToSplit);
        if (spreadToSplit(*widest) <= tolerance) break;
        Members behind = splitOff(*widest, blockers);
        clusters.push_back(std::move(behind));
    }

    Clusters result{std::vector<int>(blockers.size()), {}};
    for (const Members& members : clusters) {
        for (const std::size_t i : members) result.of[i] = static_cast<int>(result.ranges.size());
        result.ranges.push_back(rangeOf(members, blockers));
    }
    return result;
}

} // namespace shadowbench::techniques
