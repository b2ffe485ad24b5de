// What our code does where the system does not: in a copy of the test's process, which ends with the work.
#pragma once

#include <cstring>
#include <exception>
#include <functional>
#include <gtest/gtest.h>
#include <seccomp.h>
#include <string>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shadowbench::test {

/// What `work` returns, or the sentence that it throws, in a copy of this process; at most 4095 bytes.
inline std::string saidByACopy(const std::function<std::string()>& work) {
    constexpr std::size_t room = 4096; // shared memory: a pipe would take calls that may be the failing ones
    void* shared = ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return "there is no memory to share";
    auto* said = static_cast<char*>(shared);
    const pid_t copy = ::fork();
    if (copy == 0) {
        std::string text;
        try {
            text = work();
        } catch (const std::exception& error) {
            text = error.what();
        }
        std::strncpy(said, text.c_str(), room - 1);
        _exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(copy, &status, 0), copy);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the copy ended with status " << status;
    std::string text(said);
    ::munmap(shared, room);
    return text;
}

/// A system call that fails from then on, and which ones of it: by arguments, all where there are none.
struct FailingCall {
    int number; // SCMP_SYS(name)
    int error;  // errno
    std::vector<scmp_arg_cmp> arguments{};
};

/// The same, where the kernel refuses such calls.
inline std::string saidWhere(const FailingCall& call, const std::function<std::string()>& work) {
    return saidByACopy([&]() -> std::string {
        scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
        const auto count = static_cast<unsigned>(call.arguments.size());
        if (seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(static_cast<unsigned>(call.error)), call.number, count,
                                   call.arguments.data()) != 0 ||
            seccomp_load(filter) != 0)
            return "this system cannot make calls fail";
        return work();
    });
}

/// Calls of openat() whose flags, as far as `mask` goes, are `flags`.
inline FailingCall failingOpen(int error, int mask, int flags) {
    return {SCMP_SYS(openat),
            error,
            {scmp_arg_cmp{2, SCMP_CMP_MASKED_EQ, static_cast<scmp_datum_t>(mask), static_cast<scmp_datum_t>(flags)}}};
}

} // namespace shadowbench::test
