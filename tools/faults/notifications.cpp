#include "tools/faults/notifications.h"

#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <linux/audit.h>
#include <linux/filter.h>
#include <sched.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <system_error>
#include <unistd.h>

#ifndef SECCOMP_FILTER_FLAG_WAIT_KILLABLE_RECV
#define SECCOMP_FILTER_FLAG_WAIT_KILLABLE_RECV (1UL << 5)
#endif

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0; // nothing is notified
#endif

/// A watched call and where its arguments stand; −1: it has none such.
struct Watched {
    long number;
    Kind kind;
    int folder = -1, path = -1; // of open and of rename's new name
    int flags = -1;
    int oldFolder = -1, oldPath = -1;
    int descriptor = -1;
};

constexpr std::array watched{
    Watched{.number = SYS_openat, .kind = Kind::Open, .folder = 0, .path = 1, .flags = 2},
    Watched{.number = SYS_write, .kind = Kind::Write, .descriptor = 0},
    Watched{.number = SYS_pwrite64, .kind = Kind::Write, .descriptor = 0},
    Watched{.number = SYS_writev, .kind = Kind::Write, .descriptor = 0},
    Watched{.number = SYS_sendfile, .kind = Kind::Write, .descriptor = 0},
    Watched{.number = SYS_copy_file_range, .kind = Kind::Write, .descriptor = 2},
    Watched{.number = SYS_renameat, .kind = Kind::Rename, .folder = 2, .path = 3, .oldFolder = 0, .oldPath = 1},
    Watched{.number = SYS_renameat2, .kind = Kind::Rename, .folder = 2, .path = 3, .oldFolder = 0, .oldPath = 1},
    Watched{.number = SYS_fsync, .kind = Kind::Fsync, .descriptor = 0},
    Watched{.number = SYS_fdatasync, .kind = Kind::Fsync, .descriptor = 0},
    Watched{.number = SYS_clone, .kind = Kind::Fork},
    Watched{.number = SYS_clone3, .kind = Kind::Fork},
    Watched{.number = SYS_pipe2, .kind = Kind::Pipe},
#ifdef __x86_64__
    Watched{.number = SYS_open, .kind = Kind::Open, .path = 0, .flags = 1},
    Watched{.number = SYS_rename, .kind = Kind::Rename, .path = 1, .oldPath = 0},
    Watched{.number = SYS_fork, .kind = Kind::Fork},
    Watched{.number = SYS_vfork, .kind = Kind::Fork},
    Watched{.number = SYS_pipe, .kind = Kind::Pipe},
#endif
};

long seccomp(unsigned operation, unsigned long flags, void* arguments) {
    return syscall(SYS_seccomp, operation, flags, arguments);
}

bool readMemory(pid_t process, std::uint64_t address, void* into, std::size_t bytes) {
    const iovec local{into, bytes};
    const iovec remote{reinterpret_cast<void*>(address), bytes}; // NOLINT: an address of another process
    return process_vm_readv(process, &local, 1, &remote, 1, 0) == static_cast<ssize_t>(bytes);
}

/// A text that ends with 0, read page by page: what follows it may not be readable.
std::string readText(pid_t process, std::uint64_t address) {
    constexpr std::uint64_t page = 4096;
    std::string text;
    while (text.size() < PATH_MAX) {
        std::array<char, page> buffer{};
        const std::uint64_t bytes = page - address % page;
        if (!readMemory(process, address, buffer.data(), bytes)) return text;
        const std::string_view piece(buffer.data(), bytes);
        const std::size_t end = piece.find('\0');
        text += piece.substr(0, end);
        if (end != piece.npos) return text;
        address += bytes;
    }
    return text;
}

std::string linkOf(pid_t process, const std::string& name) {
    std::error_code gone;
    return fs::read_symlink(fmt::format("/proc/{}/{}", process, name), gone).string();
}

std::string absolute(pid_t process, int folder, const std::string& path) {
    if (path.empty() || path.front() == '/') return path;
    const std::string base = linkOf(process, folder == AT_FDCWD ? "cwd" : fmt::format("fd/{}", folder));
    return (fs::path(base) / path).lexically_normal().string();
}

/// Of a thread, the process that it is of.
pid_t processOf(pid_t thread) {
    std::ifstream status(fmt::format("/proc/{}/status", thread));
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Tgid:")) return std::atoi(line.c_str() + 5);
    return thread;
}

const Watched& watchedCall(int number) {
    for (const Watched& call : watched)
        if (call.number == number) return call;
    return watched.front();
}

std::uint64_t cloneFlags(const seccomp_notif& notification) {
    if (notification.data.nr == SYS_clone) return notification.data.args[0];
    std::uint64_t flags = 0; // the first member of clone3's structure
    if (notification.data.nr == SYS_clone3)
        readMemory(static_cast<pid_t>(notification.pid), notification.data.args[0], &flags, sizeof flags);
    return flags;
}

} // namespace

int installFilter() {
    std::vector<sock_filter> program;
    const auto add = [&](sock_filter line) { program.push_back(line); };
    constexpr auto number = static_cast<std::uint8_t>(watched.size());
    add(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)));
    add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 0, static_cast<std::uint8_t>(number + 1)));
    add(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)));
    for (std::uint8_t i = 0; i < number; ++i)
        add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(watched[i].number),
                     static_cast<std::uint8_t>(number - i), 0));
    add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF));
    sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
    // So that a signal that is only noted does not interrupt a call, which would then be notified twice (Linux 5.19).
    for (const unsigned long flags :
         {SECCOMP_FILTER_FLAG_NEW_LISTENER | SECCOMP_FILTER_FLAG_WAIT_KILLABLE_RECV, SECCOMP_FILTER_FLAG_NEW_LISTENER})
        if (const long listener = seccomp(SECCOMP_SET_MODE_FILTER, flags, &filter); listener >= 0)
            return static_cast<int>(listener);
    return -1;
}

std::optional<seccomp_notif> nextNotification(int listener) {
    seccomp_notif notification{};
    if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &notification) != 0) return std::nullopt;
    return notification;
}

std::optional<Call> callOf(int listener, const seccomp_notif& notification, const fs::path& program) {
    const auto thread = static_cast<pid_t>(notification.pid);
    const auto argument = [&](int i) { return notification.data.args[i]; }; // NOLINT: an index of the table above
    const Watched& line = watchedCall(notification.data.nr);
    Call call{.kind = line.kind,
              .process = processOf(thread),
              .byProgram = linkOf(thread, "exe") == program.string(),
              .path = {},
              .from = {}};
    const auto named = [&](int folder, int path) {
        return absolute(thread, folder < 0 ? AT_FDCWD : static_cast<int>(argument(folder)),
                        readText(thread, argument(path)));
    };
    if (line.path >= 0) call.path = named(line.folder, line.path);
    if (line.oldPath >= 0) call.from = named(line.oldFolder, line.oldPath);
    if (line.flags >= 0) call.creates = (argument(line.flags) & (O_WRONLY | O_RDWR)) != 0;
    if (line.descriptor >= 0) {
        call.descriptor = static_cast<int>(argument(line.descriptor));
        call.path = linkOf(thread, fmt::format("fd/{}", call.descriptor));
    }
    if (line.kind == Kind::Fork && (cloneFlags(notification) & CLONE_THREAD) != 0) call.kind = Kind::Thread;
    std::uint64_t id = notification.id; // what was read is this call's only if it still waits
    if (ioctl(listener, SECCOMP_IOCTL_NOTIF_ID_VALID, &id) != 0) return std::nullopt;
    return call;
}

void answer(int listener, const seccomp_notif& notification, int error) {
    seccomp_notif_resp response{};
    response.id = notification.id;
    response.error = -error;
    if (error == 0) response.flags = static_cast<std::uint32_t>(SECCOMP_USER_NOTIF_FLAG_CONTINUE);
    ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &response); // fails where the process is gone
}

} // namespace shadowbench::faults
