#include "tests/fuzz/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <random>
#include <utility>

namespace shadowbench::fuzz {
namespace {

using Tokens = std::vector<std::string_view>;
using Range = std::pair<std::size_t, std::size_t>; // of tokens: from the first to before the second

constexpr auto trouble = std::to_array<std::string_view>({
    "0",
    "-1",
    "1",
    "2",
    "0.5",
    "-0.0",
    "1e308",
    "-1e308",
    "1e999",
    "1e-320",
    "nan",
    "inf",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551616",
    "0x10",
    "1_0",
    "true",
    "false",
    "null",
    "[]",
    "{}",
    "[[]]",
    "[{}]",
    "\"\"",
    "\"a\"",
    "\"\\n\"",
    "\"\\u0000\"",
    "\"..\"",
    "\"../a\"",
    "\"/\"",
    "\"*\"",
    "\"{out}\"",
    "\"\\ud800\"",
    "'a'",
    "[1, 2, 3]",
    "[0, 0, 0]",
    "1979-05-27",
    "#",
});

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' || c == '+';
}
bool isBlank(char c) { return c == ' ' || c == '\t'; }

template <typename Is>
std::size_t lengthOf(std::string_view text, Is is) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, is) - text.begin());
}

std::size_t lengthOfQuoted(std::string_view text) {
    for (std::size_t i = 1; i < text.size() && text[i] != '\n'; ++i) {
        if (text[i] == '\\')
            ++i;
        else if (text[i] == text.front())
            return i + 1;
    }
    return 1;
}

class Change {
public:
    Change(std::string_view text, std::uint64_t seed) : random_(seed), tokens_(tokensOf(text)) {}

    std::string made() {
        for (std::size_t count = 1 + below(4); count > 0; --count) step();
        std::string text;
        for (const std::string_view token : tokens_) text += token;
        return text;
    }

private:
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

    /// One that is not blank, where there is one near.
    std::size_t place() {
        std::size_t at = below(tokens_.size());
        for (int tries = 0; tries < 8 && std::isspace(static_cast<unsigned char>(tokens_[at].front())) != 0; ++tries)
            at = below(tokens_.size());
        return at;
    }

    /// From a bracket to the one that closes it; of other tokens the line, or the token alone.
    Range rangeAt(std::size_t at) {
        const std::string_view token = tokens_[at];
        if (token == "{" || token == "[") {
            int depth = 0;
            for (std::size_t i = at; i < tokens_.size(); ++i) {
                if (tokens_[i] == "{" || tokens_[i] == "[") ++depth;
                if ((tokens_[i] == "}" || tokens_[i] == "]") && --depth == 0) return {at, i + 1};
            }
        }
        if (below(2) == 0) return {at, at + 1};
        std::size_t first = at, last = at;
        while (first > 0 && tokens_[first - 1] != "\n" && tokens_[first - 1] != ",") --first;
        while (last < tokens_.size() && tokens_[last] != "\n" && tokens_[last] != ",") ++last;
        return {first, std::min(last + 1, tokens_.size())};
    }

    void step() {
        if (tokens_.empty()) return void(tokens_.push_back(trouble[below(trouble.size())]));
        const std::size_t at = place();
        const auto iterator = [&](std::size_t i) { return tokens_.begin() + static_cast<std::ptrdiff_t>(i); };
        const Range range = rangeAt(at);
        const Tokens piece(iterator(range.first), iterator(range.second));
        switch (below(6)) {
        case 0:
            tokens_[at] = trouble[below(trouble.size())];
            break;
        case 1:
            tokens_[at] = tokens_[place()];
            break;
        case 2:
            std::swap(tokens_[at], tokens_[place()]);
            break;
        case 3:
            tokens_.erase(iterator(range.first), iterator(range.second));
            break;
        case 4:
            tokens_.insert(iterator(place()), piece.begin(), piece.end());
            break;
        default: {
            const std::size_t times = std::size_t{1} << below(8); // brackets nest, too
            for (std::size_t i = 0; i < times && tokens_.size() < 100'000; ++i)
                tokens_.insert(iterator(range.first), piece.begin(), piece.end());
        }
        }
    }

    std::mt19937_64 random_;
    Tokens tokens_;
};

} // namespace

Tokens tokensOf(std::string_view text) {
    Tokens tokens;
    while (!text.empty()) {
        const char c = text.front();
        const std::size_t length = isWord(c)               ? lengthOf(text, isWord)
                                   : isBlank(c)            ? lengthOf(text, isBlank)
                                   : c == '"' || c == '\'' ? lengthOfQuoted(text)
                                                           : 1;
        tokens.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return tokens;
}

std::string changed(std::string_view text, std::uint64_t seed) { return Change(text, seed).made(); }

} // namespace shadowbench::fuzz
