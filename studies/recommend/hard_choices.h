// The errors of many choices of levels under a hard light, from few labels.
#pragma once

#include "base/progress.h"
#include "studies/recommend/shadow_error.h"

#include <vector>

namespace shadowbench::recommend {

/// Every group is labelled alone at every level, once. A pixel is shadowed by a choice if one of its groups shadows it, so
/// the errors of all choices are exact from there on. Pixels on an edge of any of these shadows are left out.
class HardChoices {
public:
    /// Throws BadInput for more than `mostCasters` groups times levels. The casters must outlive it.
    HardChoices(const Casters& casters, const Receivers& receivers, const ShadowOracle& oracle,
                const Progress& progress = {});

    /// Against the finest levels.
    [[nodiscard]] Errors of(const Levels& levels) const;

private:
    [[nodiscard]] CasterSet setOf(const Levels& levels) const;

    const std::vector<CasterGroup>& groups_;
    ShadowPatterns patterns_;
};

} // namespace shadowbench::recommend
