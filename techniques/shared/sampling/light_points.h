// The points of an area light that techniques of many light samples light from.
#pragma once

#include "scene/camera.h"
#include "techniques/contract/parameters.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// `n`: how many points; `meaning` says what one costs.
Parameter lightCountParameter(const std::string& meaning);

/// `pattern`: where they lie.
Parameter lightPatternParameter();

/// `count` points of the light, in world metres. Hammersley points are regular along the light's u and Halton in base 2
/// along v; Halton points take bases 2 and 3; a grid has ⌊√count⌋ points a side and takes them again from the first when it
/// is through. Seeds start far apart in the Halton sequences.
std::vector<glm::dvec3> lightPoints(const Light& light, std::string_view pattern, int count, std::uint32_t seed);

} // namespace shadowbench::techniques
