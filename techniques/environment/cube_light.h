// Environment light as the texels of a cube map.
#pragma once

#include "scene/sky.h"

#include <vector>

namespace shadowbench::techniques {

/// Mean radiance of each texel of a cube map of side × side (techniques/environment/cube_map.h). Every sun gives as much
/// light as it has, however small it is beside a texel.
std::vector<double> cubeLight(const EnvironmentLight& light, int side);

} // namespace shadowbench::techniques
