// The cost of a technique's frame: wall time over interleaved rounds and work counters.
#pragma once

#include "harness/measure/costs.h"
#include "harness/measure/frame_passes.h"
#include "harness/measure/rounds.h"
#include "harness/render/stage.h"
#include "techniques/contract/entry.h"

namespace shadowbench::timing {

/// Renders the next frame of what the stage shows, so that the one that is measured after it follows one like it.
void settle(Stage& stage, Sequence& frames);

/// Fills in the work of the technique's next frame of what the stage shows, pass by pass: the same on every machine.
void measureWork(Stage& stage, Sequence& frames, Record& record);

/// Fills in the times of its next frames, of the frame and pass by pass.
void measureTimes(Stage& stage, const techniques::Variant& variant, Sequence& frames, Record& record);

/// Times the technique on the frame that the stage shows. Every round times one frame each of the G-buffer alone,
/// sm-uniform with default parameters, the technique, and what its cost is compared with if there is such
/// (Entry::costBase), in an order that alternates from round to round; all of them are warmed up first (the first frame
/// compiles shaders).
Time measureTime(Stage& stage, const techniques::Variant& variant, Sequence& frames, const TimingLimits& limits = {});

} // namespace shadowbench::timing
