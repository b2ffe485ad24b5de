// What `list` prints.
#pragma once

#include <string>

namespace shadowbench {

/// `what` is "techniques", "scenes" or "metrics"; `format` "text", "md" or "json".
std::string catalogue(const std::string& what, const std::string& format);

} // namespace shadowbench
