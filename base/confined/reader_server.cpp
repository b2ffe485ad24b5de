#include "base/confined/reader_server.h"

#include "base/confined/handshake.h"
#include "base/confined/passed_descriptors.h"
#include "base/error.h"
#include "base/launch.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <mutex>
#include <poll.h>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <valgrind/valgrind.h>

namespace shadowbench {
namespace {

// ---- in the parent
// --------------------------------------------------------------------------------------------------------------

/// This program's own file. Under Valgrind /proc/self/exe is Valgrind; the link that it shows us is the program.
std::filesystem::path thisProgram() {
    const std::filesystem::path link("/proc/self/exe");
    return RUNNING_ON_VALGRIND != 0 ? std::filesystem::read_symlink(link) : link;
}

/// Of whole messages: processes that are forked later share the server, and may ask at once.
std::pair<Descriptor, Descriptor> makeRequestSockets() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Inconclusive("cannot start a reader: " + std::generic_category().message(errno), failureOf(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// Our end of the socket for requests. The server ends when nobody has that end any more.
Descriptor startServer(const char* name) {
    Command command{.program = thisProgram(), .arguments = {}, .folder = "/"};
    command.cpuLimit.reset(); // each reader has its own
    command.memoryLimit.reset();
    command.fileLimit = 0;
    command.openFiles = 2 * kMostPassed;
    command.environment = std::vector<std::string>{fmt::format("{}={}", handshake::variable, name), "LC_ALL=C"};
    const Launch launch(command);
    auto [ours, servers] = makeRequestSockets();
    const Descriptor nothing = openNothing();
    start(launch, servers.get(), nothing.get(), nothing.get());
    return std::move(ours);
}

/// The servers that this process has started, by the names of their readers.
class Servers {
public:
    /// Asks for a process that has these ends; starts the server where there is none, or it has ended.
    void request(const char* name, const std::array<int, 2>& ends) {
        const std::lock_guard lock(mutex_);
        if (const auto known = sockets_.find(name); known != sockets_.end()) {
            if (passDescriptors(known->second.get(), 0, ends)) return;
            sockets_.erase(known);
        }
        const Descriptor& started = sockets_.emplace(name, startServer(name)).first->second;
        if (!passDescriptors(started.get(), 0, ends)) throw Inconclusive("cannot start a reader: its server has ended");
    }

private:
    std::mutex mutex_;
    std::map<std::string, Descriptor> sockets_;
};

// ---- in the server
// --------------------------------------------------------------------------------------------------------------

constexpr int theSocket = 0;

void dieWith(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) _exit(1); // it died before the line above took effect
}

/// Reports how `reader` ends; ends it when nobody wants to know any more.
void watchOver(pid_t reader, const Descriptor& report) {
    constexpr int tick = 5; // ms
    for (int status = 0;;) {
        if (::waitpid(reader, &status, WNOHANG) == reader) {
            ::send(report.get(), &status, sizeof status, MSG_NOSIGNAL);
            return;
        }
        pollfd watched{report.get(), POLLIN, 0};
        if (::poll(&watched, 1, tick) <= 0) continue;
        ::kill(reader, SIGKILL);
        ::waitpid(reader, &status, 0);
        return;
    }
}

/// The process of one file, and the one that watches over it.
[[noreturn]] void forkReader(pid_t server, Descriptor conversation, const Descriptor& report,
                             const std::function<void()>& serve) {
    dieWith(server);
    std::signal(SIGCHLD, SIG_DFL);
    const pid_t watcher = ::getpid();
    const pid_t process = ::fork();
    if (process == 0) {
        dieWith(watcher);
        ::dup2(conversation.get(), theSocket);
        serve();
        _exit(0);
    }
    conversation.close();
    ::close(theSocket);
    if (process > 0) watchOver(process, report);
    _exit(0);
}

} // namespace

ReaderProcess startReader(const char* name) {
    static Servers servers;
    auto [ours, readers] = makeSockets();
    auto [report, watchers] = makeSockets();
    servers.request(name, {readers.get(), watchers.get()});
    return {std::move(ours), std::move(report)};
}

void serveFiles(const std::function<void()>& serve) {
    ::close_range(3, ~0U, 0);
    ::prctl(PR_SET_PDEATHSIG, 0);  // the thread that started us may end before its process
    std::signal(SIGCHLD, SIG_IGN); // no watcher is waited for
    const pid_t server = ::getpid();
    for (;;) {
        auto handed = takeDescriptors(theSocket);
        if (!handed) _exit(0); // nobody will ask any more
        std::vector<Descriptor>& ends = handed->second;
        if (ends.size() == 2 && ::fork() == 0) forkReader(server, std::move(ends[0]), ends[1], serve);
    }
}

} // namespace shadowbench
