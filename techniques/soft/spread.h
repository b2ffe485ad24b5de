// How skirts and shadow widths spread from the outlines of casters over a map, pass by pass: as the mean of a texel's
// neighbourhood, which is the sources' repeated smoothing, or as the distance itself.
#pragma once

#include "techniques/contract/parameters.h"

namespace shadowbench::techniques {

/// `spread`, smoothing or distance.
Parameter spreadParameter(const char* byDefault, const char* source);

bool isSmoothed(const Parameters& parameters);

/// How far `passes` reach from a straight edge, in texels. A pass of the distance reaches one. After n passes of smoothing
/// 1 − erf(x / √(4n/3)) is left at x texels from an edge that keeps the value 1: the tangent of that at the edge falls to 0
/// over √(πn/3) texels.
double spreadReach(int passes, bool smoothed);

} // namespace shadowbench::techniques
