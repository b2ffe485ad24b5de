// What is installed beside the program, all written from the command line's own description.
#pragma once

#include "cli/command.h"

#include <string>

namespace shadowbench {

/// The manual page of `app` and all its verbs, as roff for man(1): what --help prints.
std::string manualPage(const CLI::App& app, const std::string& version);

/// Completion of verbs, options and their values for a shell. Ids of techniques and scenes are asked of the program when
/// they are completed.
std::string bashCompletion(const CLI::App& app);
std::string zshCompletion(const CLI::App& app);

/// Adds `documents`, the hidden verb that the build writes them with. To be added last.
void addDocuments(CLI::App& app, Action& action);

} // namespace shadowbench
