#include "studies/recommend/hard_choices.h"

#include "base/error.h"
#include "base/progress.h"

#include <fmt/format.h>

namespace shadowbench::recommend {
namespace {

/// A group at one of its levels: one bit of a CasterSet, in this order.
struct GroupAtLevel {
    std::size_t group, level;
};

std::vector<GroupAtLevel> all(const Casters& casters) {
    std::vector<GroupAtLevel> result;
    for (std::size_t group = 0; group < casters.groups().size(); ++group)
        for (std::size_t level = 0; level < casters.groups()[group].levels.size(); ++level) result.push_back({group, level});
    if (result.size() > mostCasters)
        throw BadInput(
            fmt::format("{} groups of casters have {} levels together, and at most {} can be compared: ask for fewer "
                        "bands or levels",
                        casters.groups().size(), result.size(), mostCasters));
    return result;
}

/// Which casters shadow each pixel that all of them label.
ShadowPatterns labelled(const Casters& casters, const Receivers& receivers, const ShadowOracle& oracle,
                        const Progress& progress) {
    std::vector<CasterSet> sets(receivers.primary.id.size());
    std::vector<bool> counts(sets.size(), true);
    const std::vector<GroupAtLevel> bits = all(casters);
    for (std::size_t bit = 0; bit < bits.size(); ++bit) {
        if (progress) progress(static_cast<double>(bit) / static_cast<double>(bits.size()), "shadows of each level alone");
        const Shadow shadow = oracle.shadow(casters.castAlone(bits[bit].group, bits[bit].level));
        for (std::size_t i = 0; i < sets.size(); ++i) {
            counts[i] = counts[i] && shadow.labelled[i] != 0;
            if (shadow.visibility[i] == 0) sets[i] |= CasterSet{1} << bit;
        }
    }
    std::vector<CasterSet> counted;
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (counts[i]) counted.push_back(sets[i]);
    return ShadowPatterns(std::move(counted));
}

} // namespace

HardChoices::HardChoices(const Casters& casters, const Receivers& receivers, const ShadowOracle& oracle,
                         const Progress& progress)
    : groups_(casters.groups()), patterns_(labelled(casters, receivers, oracle, progress)) {}

Errors HardChoices::of(const Levels& levels) const {
    return hardErrors(patterns_.compare(setOf(levels), setOf(Levels(levels.size(), 0))));
}

CasterSet HardChoices::setOf(const Levels& levels) const {
    CasterSet set = 0;
    std::size_t finest = 0; // the group's first bit
    for (std::size_t group = 0; group < groups_.size(); ++group) {
        set |= CasterSet{1} << (finest + levels[group]);
        finest += groups_[group].levels.size();
    }
    return set;
}

} // namespace shadowbench::recommend
