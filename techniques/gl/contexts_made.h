// What a process that forks asks itself.
#pragma once

namespace shadowbench::gl {

/// How many contexts this process, and those that it was forked from, have made. One that forks must have made none: not
/// every driver outlives a fork, even when its context is gone.
int contextsMade();

} // namespace shadowbench::gl
