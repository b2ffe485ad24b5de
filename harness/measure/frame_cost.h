// The cost of a technique's frame: wall time over interleaved rounds and work counters.
#pragma once

#include "harness/records/record.h"
#include "harness/render/stage.h"
#include "techniques/contract/entry.h"

#include <cstdint>

namespace shadowbench::timing {

struct CostOptions {
    int minimumRounds = 3;
    int maximumRounds = 25;
    double budgetSeconds = 1.5; // of measuring one cell, once the minimum is done
    bool time = true;           // off: work only, which is the same on every machine
};

/// Measures `technique` on the frame that the stage shows. Every round times one frame each of the G-buffer alone,
/// sm-uniform with default parameters, what its cost is compared with if there is such (Entry::costBase), and the technique,
/// in an order that alternates from round to round; all of them are warmed up first (the first frame compiles shaders). `index` numbers the first frame
/// rendered.
Cost measureCost(Stage& stage, const techniques::Variant& variant, techniques::Technique& technique, std::uint64_t bytes,
                 int index, std::uint32_t seed, const CostOptions& options);

} // namespace shadowbench::timing
