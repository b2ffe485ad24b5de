// Drift: what small changes of many commits add up to since an anchor.
#pragma once

#include "harness/gate/watchlist.h"
#include "harness/records/compare.h"

#include <cstddef>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct AnchorJudgement {
    std::vector<Change> changes;    // Worse ones only, each by more than the limit
    std::vector<std::string> notes; // what could not be compared, once for each reason
    std::size_t compared = 0;       // numbers
};

/// `now` against the anchor's records. A change is Worse when it is larger than the anchor's limit times what one commit may
/// change; what came or went since is the base's to judge.
AnchorJudgement judgeDrift(const Anchor& anchor, const std::vector<Record>& before, const std::vector<Record>& now);

} // namespace shadowbench::gate
