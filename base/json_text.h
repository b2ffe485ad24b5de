// JSON that others wrote: what is checked around its parser. The header does not bring nlohmann's JSON; who includes it
// does.
#pragma once

#include "base/error.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>

namespace shadowbench {

inline constexpr std::size_t largestObject = 10'000; // members; an ordered object looks through all of them for each

/// `text`, unless it nests deeper than Limit::Nesting (base/limits.h), since the library copies, compares and prints values
/// by recursion, or has a larger object: throws BadInput, "<what>: …". Whether it is JSON at all is for the parser to say.
std::string_view boundedJson(std::string_view text, std::string_view what);

/// The whole number that a value of JSON is. Throws BadInput for other values and what T does not hold, which the library
/// would cut off.
template <std::integral T>
T wholeNumber(const auto& json) {
    const bool fits = json.is_number_unsigned()  ? std::in_range<T>(json.template get<std::uint64_t>())
                      : json.is_number_integer() ? std::in_range<T>(json.template get<std::int64_t>())
                                                 : false;
    if (!fits)
        throw BadInput(fmt::format("{} is no whole number from {} to {}", json.dump(), std::numeric_limits<T>::min(),
                                   std::numeric_limits<T>::max()));
    return json.template get<T>();
}

} // namespace shadowbench
