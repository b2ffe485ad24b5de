// The kernel's side of supervision: a filter of system calls whose decisions are made by another process.
#pragma once

#include "tools/faults/supervised.h"

#include <linux/seccomp.h>
#include <optional>

namespace shadowbench::faults {

/// In the process that is to be supervised, before exec: the descriptor of its notifications, or −1 with errno.
int installFilter();

/// The next call that waits for a decision; nothing if its process is gone.
std::optional<seccomp_notif> nextNotification(int listener);

/// What is about to be called; `program` tells the program from its tools. Nothing if it is no call of interest (a thread's
/// start that only looks like a fork is one), or its process is gone.
std::optional<Call> callOf(int listener, const seccomp_notif& notification, const std::filesystem::path& program);

/// Lets the call go on (0) or fail.
void answer(int listener, const seccomp_notif& notification, int error);

} // namespace shadowbench::faults
