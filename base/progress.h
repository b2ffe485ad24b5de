// Progress of long work, decoupled from how it is shown.
#pragma once

#include <functional>
#include <string_view>

namespace shadowbench {

/// Called now and then with the finished share in [0, 1] and what is being done; may be empty.
using Progress = std::function<void(double done, std::string_view what)>;

} // namespace shadowbench
