#include "base/json_text.h"

#include "base/limits.h"

#include <vector>

namespace shadowbench {
namespace {

/// Where a text in quotes that begins at `at` ends: its closing quote.
std::size_t endOfQuoted(std::string_view text, std::size_t at) {
    for (++at; at < text.size() && text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    return at;
}

} // namespace

std::string_view boundedJson(std::string_view text, std::string_view what) {
    const std::uint64_t deepest = limitOf(Limit::Nesting);
    std::vector<std::size_t> colons(1); // of the object that is open at each level
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"') at = endOfQuoted(text, at);
        if ((c == '}' || c == ']') && colons.size() > 1) colons.pop_back();
        if (c == ':' && ++colons.back() > largestObject)
            throw BadInput(fmt::format("{}: an object has more than {} members", what, largestObject));
        if (c != '{' && c != '[') continue;
        if (colons.size() > deepest)
            throw BadInput(fmt::format("{}: its lists and objects are nested deeper, {}", what, beyond(Limit::Nesting)));
        colons.push_back(0);
    }
    return text;
}

} // namespace shadowbench
