// The cost of a technique's frame: wall time over interleaved rounds and work counters.
#pragma once

#include "harness/measure/costs.h"
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

/// The work of one frame, number `index` of the technique's sequence, of what the stage shows: the same on every machine.
/// `bytes` are those that the technique holds.
Work measureWork(Stage& stage, techniques::Technique& technique, std::uint64_t bytes, int index, std::uint32_t seed);

/// Times `technique` on the frame that the stage shows. Every round times one frame each of the G-buffer alone,
/// sm-uniform with default parameters, what its cost is compared with if there is such (Entry::costBase), and the technique,
/// in an order that alternates
/// from round to round; all of them are warmed up first (the first frame compiles shaders). `index` numbers the first frame
/// rendered.
Time measureTime(Stage& stage, const techniques::Variant& variant, techniques::Technique& technique, int index,
                 std::uint32_t seed, const TimingLimits& limits = {});

} // namespace shadowbench::timing
