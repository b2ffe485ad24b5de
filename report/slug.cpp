#include "report/slug.h"

#include "base/hash.h"

#include <cctype>
#include <fmt/format.h>
#include <string_view>

namespace shadowbench::report {
namespace {

constexpr std::size_t longestSlug = 80;

bool isSafe(char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x80 && (std::isalnum(byte) != 0 || std::string_view(".=+-_,").find(letter) != std::string_view::npos);
}

} // namespace

std::string slug(const std::string& name) {
    std::string text = name.substr(0, longestSlug);
    bool changed = text.size() < name.size() || name.empty() || name.front() == '.';
    for (char& letter : text) {
        if (isSafe(letter)) continue;
        changed = changed || letter != ':'; // which separates a variant's parameters
        letter = '_';
    }
    if (!text.empty() && text.front() == '.') text.front() = '_';
    return changed ? fmt::format("{}-{}", text, hash128(name).text().substr(0, 8)) : text;
}

} // namespace shadowbench::report
