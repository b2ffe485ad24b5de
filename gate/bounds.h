// Scores that techniques must keep, whatever the base scores.
#pragma once

#include "gate/gate_config.h"
#include "harness/records/compare.h"

#include <vector>

namespace shadowbench::gate {

/// "leak below 0.1".
std::string text(const Bound& bound);

/// A scene's `[expect]` as bounds.
std::vector<BoundRule> boundsOf(const Scene& scene);

/// One change for every bound and record that it covers, whatever its seed: Worse when the bound is broken. An expected
/// failure that has stopped failing is broken, too. NotCompared is a metric that the record lacks and, where `all` cells
/// were measured, a bound that covers none.
std::vector<Change> judgeBounds(const std::vector<Record>& records, const std::vector<BoundRule>& bounds, bool all = false);

} // namespace shadowbench::gate
