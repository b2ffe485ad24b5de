// What `list` prints.
#pragma once

#include "techniques/catalog.h"

#include <string>

namespace shadowbench {

/// `what` is "techniques", "scenes", "metrics" or "limits"; `format` "text", "md" or "json". "schema" is the JSON Schema of
/// a record, whatever the format.
std::string catalogue(const std::string& what, const std::string& format);

/// "soft shadows, area lights": what kind of answer a technique gives, and for which lights.
std::string answerOf(const techniques::Entry& entry);

} // namespace shadowbench
