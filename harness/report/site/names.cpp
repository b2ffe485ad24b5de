#include "harness/report/site/names.h"

#include "base/hash.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <string_view>

namespace shadowbench::site {
namespace {

constexpr std::size_t longestSlug = 80, longestShown = 160;

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

std::string sceneAddress(const std::string& scene) { return fmt::format("scenes/{}.html", slug(scene)); }

std::string cellAddress(const Record& record) {
    return fmt::format("cells/{}.html#{}", slug(record.scene), slug(record.variant));
}

std::string shown(const std::string& name) {
    if (name.size() <= longestShown) return name;
    std::size_t end = longestShown;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end; // a character stays whole
    return fmt::format("{}… ({} bytes)", name.substr(0, end), name.size());
}

} // namespace shadowbench::site
