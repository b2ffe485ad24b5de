// What techniques over moments of depth share; their mathematics is in filtered/moments.glsl.
#pragma once

#include "techniques/contract/parameters.h"

namespace shadowbench::techniques {

/// `variance`: the least variance of every technique over moments of depths in [0, 1].
Parameter leastVarianceParameter();

} // namespace shadowbench::techniques
