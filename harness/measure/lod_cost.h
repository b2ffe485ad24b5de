// The cost of a level-of-detail technique's frames along the walk.
#pragma once

#include "harness/measure/costs.h"
#include "harness/render/lod_stage.h"

#include <vector>

namespace shadowbench::lod {

/// How long a walk is timed.
struct LodTimingLimits {
    int maximumRounds = 5;
    double budgetSeconds = 0.8; // of timing one technique, once the least has been done
    int leastFrames = 3;        // timed at least, of a walk that takes longer than the budget
};

struct LodCost {
    LodTime time;
    std::vector<double> milliseconds; // by frame from the walk's first: the least of all rounds
};

/// Times `technique` frame after frame beside lod-switch, the two in an order that alternates; both are warmed up first.
/// Walks are repeated, or cut short, to fit the budget. The technique's history is reset.
LodCost measureLodCost(LodStage& stage, techniques::LodTechnique& technique, int frames, const LodTimingLimits& limits = {});

/// `own` and `base`: milliseconds by frame, equally many, at least two.
LodTime timeOf(const std::vector<double>& own, const std::vector<double>& base);

} // namespace shadowbench::lod
