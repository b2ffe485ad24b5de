// What the passes of technique folders draw with.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

/// Hashes of shaders and state by the names of the passes, of a technique that is a folder; of one in C++ none.
const std::map<std::string, std::string>& drawnWith(std::string_view id);

} // namespace shadowbench::techniques
