// What a technique folder declares and nothing uses.
#pragma once

#include "techniques/folder/description.h"

#include <string>
#include <vector>

namespace shadowbench::techniques {

/// A line each, with file, line and name: parameters that no shader and no key reads, and targets that no pass reads. The
/// names of a shader's text count, whatever its #if leave out: with other parameters they may be read. Nothing of a folder
/// with an #include that leads nowhere: that is an error of its own.
std::vector<std::string> unusedIn(const TechniqueFolder& folder);

} // namespace shadowbench::techniques
