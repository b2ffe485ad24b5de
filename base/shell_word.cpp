#include "base/shell_word.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace shadowbench {

std::string shellWord(const std::string& word) {
    const auto plain = [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
               std::string_view("-_=+.,:/").find(letter) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, plain)) return word;
    std::string text = "'";
    for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return text + "'";
}

} // namespace shadowbench
