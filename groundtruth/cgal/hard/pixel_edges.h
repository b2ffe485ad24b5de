// Shadow edges as far as labels of pixels tell.
#pragma once

#include "groundtruth/contract/reference.h"

namespace shadowbench::groundtruth {

/// How far (pixels) edge distances are told; infinity beyond.
inline constexpr double edgeReach = 8;

/// Fills `out.edgeDistance` of the receivers from the labels: the distance to the nearest midpoint between neighbouring
/// pixels (8) of which one is lit and the other not; ½ for those pixels themselves, diagonal ones included; 0 for pixels on
/// an edge. A surface that faces away counts as shadowed beside its own receivers.
void edgeDistanceFromLabels(Reference& out);

} // namespace shadowbench::groundtruth
