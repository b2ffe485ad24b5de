// What a technique's frame costs where nothing is as in the frame before: light and casters in motion
// (harness/render/motion.h), and the first frame of all. The standing frame's cost lacks what a technique keeps from frame
// to frame.
#pragma once

#include "harness/measure/frame_passes.h"
#include "harness/render/motion.h"
#include "techniques/contract/entry.h"

#include <cstdint>
#include <memory>

namespace shadowbench::timing {

/// Fills in the work of a frame in motion of what the stage shows, once that of the standing frame is.
void measureMotionWork(Stage& stage, Casters casters, Sequence& frames, Record& record);

/// Fills in its times, beside sm-uniform's.
void measureMotionTime(Stage& stage, Casters casters, Sequence& frames, Record& record);

/// Renders the first frame of a technique's sequence. Fills in its work.
void measureFirstWork(Stage& stage, Sequence& frames, Record& record);

/// Renders the sequence's first frame of what the stage shows, for a technique without a history: after one with light and
/// casters elsewhere, so that it is one in motion. Fills in the work of both. An image that is not that of the frame alone
/// shows a cache that misses a change.
void measureFirstAndMotionWork(Stage& stage, Casters casters, Sequence& frames, Record& record);

/// Leaves out the passes of the first frame and of that in motion where they run and draw as those of the standing frame.
/// (The first frame's fragments may be others, since light and casters are elsewhere.)
void keepChangedPasses(Record& record);

/// Makes the technique and times its first frame, of what the stage shows, as number `index`; then, once more, from nothing
/// (Technique::reset), what it is without compiling. Returns the technique after that frame.
std::unique_ptr<techniques::Technique> measureFirstTime(Stage& stage, const techniques::Variant& variant, int index,
                                                        std::uint32_t seed, Record& record);

} // namespace shadowbench::timing
