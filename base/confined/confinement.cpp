#include "base/confined/confinement.h"

#include <cerrno>
#include <fmt/format.h>
#include <initializer_list>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

// Of the sanitizers' libraries, where they are linked: g++ and clang have different macros, and none for a library alone.
// NOLINTBEGIN(bugprone-reserved-identifier): their own names
extern "C" void __asan_init() __attribute__((weak));
extern "C" void __tsan_init() __attribute__((weak));
// NOLINTEND(bugprone-reserved-identifier)

namespace shadowbench {
namespace {

/// The second is what no process without privileges can raise the first above.
void limit(__rlimit_resource resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(resource, &both);
}

void setLimits(std::uint64_t memory, std::uint64_t seconds) {
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_NPROC, 0);
    limit(RLIMIT_NOFILE, 0); // those that are open stay so
    limit(RLIMIT_MEMLOCK, 0);
    if (!hasSanitizer()) limit(RLIMIT_AS, memory);
    const rlimit time{seconds, seconds + 1}; // first a signal of its own, by which the reason is known
    setrlimit(RLIMIT_CPU, &time);
}

/// Landlock's attributes as of its version 6; the header of Debian 12 has the first alone.
struct LandlockRules {
    std::uint64_t files = 0, network = 0, scopes = 0;
};

/// A ruleset that handles everything and allows nothing.
int denyFiles() {
    const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return 0;
    LandlockRules rules;
    rules.files = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1; // of version 1
    if (version >= 2) rules.files |= 1U << 13U;            // to rename between folders
    if (version >= 3) rules.files |= 1U << 14U;            // to truncate
    if (version >= 5) rules.files |= 1U << 15U;            // to control devices
    if (version >= 4) rules.network = 3;                   // to bind and to connect by TCP
    if (version >= 6) rules.scopes = 3;                    // to reach other processes' sockets and to send them signals
    const std::size_t size = version >= 6 ? sizeof rules : version >= 4 ? 2 * sizeof rules.files : sizeof rules.files;
    const long set = syscall(SYS_landlock_create_ruleset, &rules, size, 0);
    if (set < 0) return 0;
    const bool holds = syscall(SYS_landlock_restrict_self, set, 0) == 0;
    ::close(static_cast<int>(set));
    return holds ? static_cast<int>(version) : 0;
}

/// A filter under construction.
class Filter {
public:
    Filter() : context_(seccomp_init(SCMP_ACT_KILL_PROCESS)) {}
    ~Filter() {
        if (context_ != nullptr) seccomp_release(context_);
    }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    void allow(std::initializer_list<int> calls) {
        for (const int call : calls) add(SCMP_ACT_ALLOW, call, {});
    }
    /// Only with an argument like that.
    void allow(int call, scmp_arg_cmp argument) { add(SCMP_ACT_ALLOW, call, {argument}); }
    /// They fail with `error`, as libraries expect of what they try and can do without.
    void refuse(int error, std::initializer_list<int> calls) {
        for (const int call : calls) add(SCMP_ACT_ERRNO(static_cast<unsigned>(error)), call, {});
    }
    bool load() {
        if (context_ == nullptr || failed_) return false;
        seccomp_attr_set(context_, SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS);
        return seccomp_load(context_) == 0;
    }

private:
    void add(std::uint32_t action, int call, std::initializer_list<scmp_arg_cmp> arguments) {
        if (context_ == nullptr) return;
        const auto count = static_cast<unsigned>(arguments.size());
        failed_ |= seccomp_rule_add_array(context_, action, call, count, arguments.begin()) != 0;
    }

    scmp_filter_ctx context_;
    bool failed_ = false;
};

bool filterSystemCalls(int socket) {
    Filter filter;
    const auto same = [](unsigned argument, std::uint64_t value) { return scmp_arg_cmp{argument, SCMP_CMP_EQ, value, 0}; };
    const scmp_arg_cmp notExecutable{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0};
    filter.allow({SCMP_SYS(read), SCMP_SYS(pread64), SCMP_SYS(recvfrom), SCMP_SYS(lseek), SCMP_SYS(close)});
    filter.allow(SCMP_SYS(sendto), same(0, static_cast<std::uint64_t>(socket)));
    filter.allow(SCMP_SYS(mmap), notExecutable);
    filter.allow(SCMP_SYS(mprotect), notExecutable);
    filter.allow({SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise)});
    filter.allow({SCMP_SYS(futex), SCMP_SYS(sched_yield), SCMP_SYS(sched_getaffinity), SCMP_SYS(restart_syscall)});
    filter.allow({SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(getrandom), SCMP_SYS(sysinfo), SCMP_SYS(uname)});
    filter.allow({SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(exit), SCMP_SYS(exit_group)});
    filter.allow({SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack)});
    filter.allow(SCMP_SYS(tgkill), same(0, static_cast<std::uint64_t>(getpid()))); // abort() sends itself a signal
    filter.allow(SCMP_SYS(prlimit64), same(2, 0));                                 // only to ask
    filter.refuse(EACCES, {SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2),
                           SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(fstat), SCMP_SYS(newfstatat), SCMP_SYS(statx),
                           SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(getcwd), SCMP_SYS(ioctl), SCMP_SYS(fcntl),
                           SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(prctl)});
    filter.refuse(EAGAIN, {SCMP_SYS(clone), SCMP_SYS(clone3)}); // as if there were no room for a thread
    return filter.load();
}

} // namespace

bool hasSanitizer() { return __asan_init != nullptr || __tsan_init != nullptr; }

std::string Protections::inWords() const {
    std::string words = "limits";
    if (systemCalls) words += ", a filter of system calls (seccomp)";
    if (landlock > 0) words += fmt::format(", Landlock {}", landlock);
    return words;
}

Protections confineThisProcess(int socket, std::uint64_t memory, std::uint64_t seconds) {
    Protections protections;
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0); // which both filters ask for
    prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
    protections.landlock = denyFiles();
    setLimits(memory, seconds);
    if (!hasSanitizer()) protections.systemCalls = filterSystemCalls(socket);
    return protections;
}

} // namespace shadowbench
