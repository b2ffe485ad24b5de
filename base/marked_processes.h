// Processes known by a variable of their environment, which they hand on to all that they start, wherever that goes: a
// process group is left with setsid(), and a daemon has no parent.
#pragma once

#include <string>

namespace shadowbench {

/// A variable, as NAME=value, that no other process has.
std::string newMark();

/// Kills the processes of this user that have the variable in their environment, and those that they start meanwhile.
void endMarked(const std::string& mark);

} // namespace shadowbench
