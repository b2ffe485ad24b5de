// Sentences that hold words of files, which may hold anything.
#pragma once

#include <string>

namespace shadowbench {

/// `text` for a terminal: line ends and other control characters become blanks, and what is longer than some screens is cut.
std::string onOneLine(std::string text);

} // namespace shadowbench
