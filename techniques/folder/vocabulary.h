// What the shaders of a technique folder may name.
#pragma once

#include "techniques/folder/description.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// Those that the program sets: its own, and patterns and targets by their names.
std::vector<std::string> uniformNames(const TechniqueFolder& folder);

/// Identifiers, macros and keywords of a shader's text, without its comments.
std::set<std::string> namesIn(std::string_view glsl);

} // namespace shadowbench::techniques
