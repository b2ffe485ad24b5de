// What `list` prints.
#pragma once

#include <string>

namespace shadowbench {

/// `what` is "techniques", "scenes", "metrics" or "limits"; `format` "text", "md" or "json". "schema" is the JSON Schema of
/// a record, whatever the format.
std::string catalogue(const std::string& what, const std::string& format);

} // namespace shadowbench
