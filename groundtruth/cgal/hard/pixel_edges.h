// Distances to shadow edges, estimated from the labels of pixels.
#pragma once

#include "groundtruth/contract/reference.h"

namespace shadowbench::groundtruth::hard {

/// The largest edge distance that is measured, in pixels; infinity beyond.
inline constexpr double edgeReach = 8;

/// Fills `out.edgeDistance` of the receivers from the labels: the distance to the nearest midpoint between neighbouring
/// pixels (8) of which one is lit and the other not; ½ for those pixels themselves, diagonal ones included; 0 for pixels on
/// an edge. A surface that faces away counts as shadowed beside its own receivers.
void edgeDistanceFromLabels(Reference& out, int threads);

} // namespace shadowbench::groundtruth::hard
