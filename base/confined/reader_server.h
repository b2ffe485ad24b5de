// A reader takes long to start: this program's libraries are many. So it is started once for all files of its kind, and
// forks a process for each of them, which has seen no other file.
#pragma once

#include "base/descriptor.h"

#include <functional>

namespace shadowbench {

/// A reader's process for one file, as its parent holds it.
struct ReaderProcess {
    Descriptor conversation; // with it
    Descriptor report;       // its status as of waitpid() comes when it ends; closing this ends it
};

/// Starts one for the reader called `name`, by its server, which is started for the first file of this process. Throws
/// Inconclusive when it cannot be started.
ReaderProcess startReader(const char* name);

/// In the server, whose standard input is the parent's socket: for each file a process that calls `serve` with the
/// conversation as its standard input, and is ended when the parent closes its report or dies. Returns never.
[[noreturn]] void serveFiles(const std::function<void()>& serve);

} // namespace shadowbench
