// What a process says when something ends it that no exception handler sees.
#pragma once

namespace shadowbench {

/// From now on an abort of this process (a library's assertion, an exception that leaves a thread or a destructor) ends it
/// with one line on standard error and ExitCode::Internal, without the files that it is writing (base/live_files.h).
/// Processes that are forked from it still end by the signal, which their parent reports. May be called before any object or
/// library is initialised.
void sayWhyAborted();

} // namespace shadowbench
