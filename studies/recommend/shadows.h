// The shadow of a snapshot's casters at the receivers of another: casters exchanged, surface points the same.
#pragma once

#include "studies/recommend/receivers.h"

#include <cstdint>
#include <functional>
#include <string>

namespace shadowbench::recommend {

struct Shadow {
    Image<float> visibility;      // visible fraction of the light in [0, 1]; 0 or 1 of a hard light
    Image<std::uint8_t> labelled; // 1 at the receivers, but for those exactly on a shadow edge or in the light's plane
};

/// One way to the truth. Snapshots must hold the receivers' own surfaces under the ids and triangles of the frame as drawn,
/// as those of Casters do. The receivers must outlive it.
struct ShadowOracle {
    std::string name;
    std::function<Shadow(const Snapshot&)> shadow;
};

/// Hard lights: exact, `polygon` on planar receivers and `rays` on others. Casters are labelled in parts of at most
/// `mostTriangles`, as many at once as the machine runs threads: their shadow is the union of the parts', and silhouettes
/// take memory.
ShadowOracle polygonOracle(const Receivers& receivers, std::size_t mostTriangles = 2'000'000);

/// Hard lights: exact, `rays` on all receivers.
ShadowOracle rayOracle(const Receivers& receivers);

/// Area lights: the exact visible fraction.
ShadowOracle areaOracle(const Receivers& receivers);

/// Area lights, sharing no step with the above: the mean of exact labels by `rays` from `samples` points of the light, those
/// of the POV-Ray oracle. Two shadows of one oracle see the same points, so that what they differ in is not noise of the
/// choice of points; a penumbra is as coarse as the points are few.
ShadowOracle sampledOracle(const Receivers& receivers, int samples);

} // namespace shadowbench::recommend
