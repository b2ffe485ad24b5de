// The cost of a technique's frame: wall time over interleaved rounds and work counters.
#pragma once

#include "harness/measure/costs.h"
#include "harness/measure/frame_passes.h"
#include "harness/render/stage.h"
#include "techniques/contract/entry.h"

#include <cstdint>

namespace shadowbench::timing {

/// How long a technique's frames are timed.
struct TimingLimits {
    int minimumRounds = 3;
    int maximumRounds = 25;
    double budgetSeconds = 1.5; // once the minimum is done
};

/// Fills in the costs of the technique's next frames of what the stage shows: work, the same on every machine, pass by pass;
/// where `timed`, times, too. `bytes` are those that the technique holds.
void measureCosts(Stage& stage, const techniques::Variant& variant, Sequence frames, std::uint64_t bytes, bool timed,
                  Record& record);

/// Times the technique on the frame that the stage shows. Every round times one frame each of the G-buffer alone,
/// sm-uniform with default parameters, what its cost is compared with if there is such (Entry::costBase), the technique, and
/// the bare passes if there are such, in an order that alternates from round to round; all of them are warmed up first (the
/// first frame compiles shaders).
Time measureTime(Stage& stage, const techniques::Variant& variant, Sequence& frames,
                 const std::vector<techniques::BarePass>& bare, const TimingLimits& limits = {});

} // namespace shadowbench::timing
