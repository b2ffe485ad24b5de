// Which placements can cast a shadow on another one at all, for techniques that keep blockers apart from receivers. No GL.
#pragma once

#include "scene/snapshot.h"

#include <vector>

namespace shadowbench::techniques {

/// For each placement, counted through the snapshot's batches in order, whether its bounding box may stand between the area
/// light and some other box. It cannot where one of its sides has all of the light and nine tenths or more of the other box
/// before it: a tenth may be sunk into what it stands on.
std::vector<bool> blockers(const Snapshot& snapshot);

} // namespace shadowbench::techniques
