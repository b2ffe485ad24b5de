#include "base/memory_bound.h"

#include "base/confined/confinement.h"
#include "base/error.h"
#include "base/files.h"
#include "base/live_files.h"
#include "base/worker_processes.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

namespace shadowbench {
namespace {

constexpr std::array signals{SIGSEGV, SIGBUS, SIGABRT};

// A signal handler can reach nothing but statics, and where the stack is full it needs another.
std::array<char, 4096> words;
std::size_t length = 0;
std::array<char, 65536> ownStack;
std::array<struct sigaction, signals.size()> before;
stack_t stackBefore;
rlimit limitBefore;

void onSignal(int /*signal*/) {
    const std::string_view sentence(words.data(), length);
    if (!sendFailure(sentence)) {
        for (const std::string_view part : {std::string_view("shadowbench: "), sentence, std::string_view("\n")})
            if (write(STDERR_FILENO, part.data(), part.size()) < 0) break;
        removeLiveFiles();
    }
    _exit(static_cast<int>(ExitCode::BadInput));
}

/// What counts against RLIMIT_DATA.
std::uint64_t ownMemory() {
    std::istringstream fields(readFile("/proc/self/statm"));
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field) fields >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

} // namespace

MemoryBound::MemoryBound(std::uint64_t bytes, const std::string& sentence) {
    if (hasSanitizer()) return;
    length = std::min(sentence.size(), words.size());
    std::copy_n(sentence.begin(), length, words.begin());
    const stack_t stack{.ss_sp = ownStack.data(), .ss_flags = 0, .ss_size = ownStack.size()};
    sigaltstack(&stack, &stackBefore);
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before[i]);
    getrlimit(RLIMIT_DATA, &limitBefore);
    rlimit limit = limitBefore;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, ownMemory() + bytes);
    setrlimit(RLIMIT_DATA, &limit);
}

MemoryBound::~MemoryBound() {
    if (hasSanitizer()) return;
    setrlimit(RLIMIT_DATA, &limitBefore);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before[i], nullptr);
    sigaltstack(&stackBefore, nullptr);
}

} // namespace shadowbench
