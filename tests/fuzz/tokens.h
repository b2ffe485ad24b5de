// Changes of a text's tokens. Random bytes seldom get past a parser of JSON or TOML; a number in another's place does.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::fuzz {

/// Numbers, words, texts in quotes with their quotes, runs of blanks, line ends and single other characters; together they
/// are `text` again.
std::vector<std::string_view> tokensOf(std::string_view text);

/// `text` with a few changes, the same for the same seed: a token replaced by another of the text or by one that readers
/// stumble over, and a token, a line or all between two brackets left out, repeated or put elsewhere.
std::string changed(std::string_view text, std::uint64_t seed);

} // namespace shadowbench::fuzz
