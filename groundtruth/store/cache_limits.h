// Sizes and time spans as text: on the command line, in environment variables and in messages.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace shadowbench::groundtruth {

/// "500M", "4G", "1.5 GiB", "1048576": a number and K, M, G or T (powers of 1024, case and a following B or iB do not
/// matter). Throws BadInput naming the text and what is valid.
std::uintmax_t bytesOf(std::string_view text);

/// "90m", "12h", "30d", "2w": a number and s, m (minutes), h, d or w. Throws BadInput naming the text and what is valid.
std::chrono::seconds durationOf(std::string_view text);

/// "1.4 GiB", "640 B".
std::string bytesText(std::uintmax_t bytes);

/// "3 d", "12 h", "5 min", "40 s": rounded down to the largest unit.
std::string durationText(std::chrono::seconds duration);

} // namespace shadowbench::groundtruth
