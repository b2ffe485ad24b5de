// The cost of level-of-detail techniques over the size of the picture (dissertation Fig. 5.8).
#pragma once

#include "studies/sweep/sweep.h"

namespace shadowbench::lod {

inline constexpr const char* viewportAxis = "viewport";

/// Runs every chosen level-of-detail technique on a square picture of every size in `options.values` (128 … 1024 pixels if
/// there are none), timed beside lod-switch; at most `frames` of the walk. Records as of a sweep; their curve is the
/// variant. Throws BadInput where the scene has no walk or none of the techniques draws levels of detail.
SweepResult viewportCurve(const SweepOptions& options, int frames = 12);

} // namespace shadowbench::lod
