// The words that people write for the values of an enumeration, and what they may have meant by another word.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench {

/// The near matches of `word` among `known` (edit distance), to follow the wrong word in an error message: ` (did you mean
/// "pcss"?)`, or nothing.
std::string didYouMean(std::string_view word, const std::vector<std::string>& known);

/// Throws BadInput: there is no `kind` of that name, its near matches, and all that there are.
[[noreturn]] void throwUnknownWord(std::string_view kind, std::string_view word, const std::vector<std::string>& known);

/// An enumeration's words, each value once: `constexpr Words<Oracle, 2> oracles{"oracle", {{{Oracle::Auto, "auto"}, …}}}`.
template <class Value, std::size_t Count>
struct Words {
    std::string_view kind; // what the values are, in messages
    std::array<std::pair<Value, std::string_view>, Count> words;

    [[nodiscard]] constexpr std::string_view of(Value value) const {
        const auto found = std::ranges::find(words, value, &std::pair<Value, std::string_view>::first);
        return found == words.end() ? std::string_view() : found->second;
    }

    [[nodiscard]] std::vector<std::string> all() const {
        std::vector<std::string> result;
        for (const auto& [value, word] : words) result.emplace_back(word);
        return result;
    }

    /// The value of a word; throws BadInput for another one.
    [[nodiscard]] Value named(std::string_view word) const {
        const auto found = std::ranges::find(words, word, &std::pair<Value, std::string_view>::second);
        if (found == words.end()) throwUnknownWord(kind, word, all());
        return found->first;
    }
};

} // namespace shadowbench
