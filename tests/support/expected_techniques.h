// The techniques that scenes may expect something of: those of the catalogue, and rows that it does not have yet.
#pragma once

#include "techniques/catalog.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace shadowbench {

/// Shadow techniques of the documents that are still to be built. A row that is built leaves this list.
inline constexpr std::array<std::string_view, 0> techniquesToCome{};

inline std::string idOf(const std::string& variant) { return variant.substr(0, variant.find(':')); }

inline bool inCatalogue(std::string_view id) {
    const auto catalog = techniques::catalog();
    return std::any_of(catalog.begin(), catalog.end(), [&](const techniques::Entry& entry) { return entry.id == id; });
}

inline bool isToCome(std::string_view id) {
    return std::find(techniquesToCome.begin(), techniquesToCome.end(), id) != techniquesToCome.end();
}

} // namespace shadowbench
