#include "base/one_line.h"

#include <algorithm>

namespace shadowbench {

std::string onOneLine(std::string text) {
    constexpr std::size_t longest = 8192;
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    if (text.size() <= longest) return text;
    std::size_t end = longest; // not within a character of UTF-8
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) --end;
    return text.substr(0, end) + "…";
}

} // namespace shadowbench
