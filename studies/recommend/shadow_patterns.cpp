#include "studies/recommend/shadow_patterns.h"

#include <algorithm>

namespace shadowbench::recommend {

void LabelErrors::add(bool shadow, bool exact, std::size_t pixels) {
    (exact ? shadowed : lit) += pixels;
    if (shadow != exact) (exact ? leak : falseShadow) += pixels;
}

ShadowPatterns::ShadowPatterns(std::vector<CasterSet> pixels) {
    std::ranges::sort(pixels);
    for (const CasterSet set : pixels) {
        if (counts_.empty() || counts_.back().first != set) counts_.emplace_back(set, 0);
        ++counts_.back().second;
    }
}

LabelErrors ShadowPatterns::compare(CasterSet casters, CasterSet exact) const {
    LabelErrors errors;
    for (const auto& [set, pixels] : counts_) errors.add((set & casters) != 0, (set & exact) != 0, pixels);
    return errors;
}

} // namespace shadowbench::recommend
