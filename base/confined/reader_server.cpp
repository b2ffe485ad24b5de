#include "base/confined/reader_server.h"

#include "base/confined/handshake.h"
#include "base/confined/passed_descriptors.h"
#include "base/error.h"
#include "base/faults.h"
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
    if (faults::fails(faults::Point::Pipe) || ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
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

/// A process that reads a file, and whom its end is reported to.
struct Watched {
    pid_t reader;
    Descriptor report;

    /// Whether it has ended, which is then reported; it is ended when nobody wants to know any more.
    [[nodiscard]] bool hasEnded(bool abandoned) const {
        if (abandoned) ::kill(reader, SIGKILL);
        int status = 0;
        if (::waitpid(reader, &status, abandoned ? 0 : WNOHANG) != reader) return false;
        ::send(report.get(), &status, sizeof status, MSG_NOSIGNAL);
        return true;
    }
};

/// Forks the process of one file.
pid_t forkReader(pid_t server, const Descriptor& conversation, const std::function<void()>& serve) {
    const pid_t process = faults::fails(faults::Point::Fork) ? -1 : ::fork();
    if (process != 0) return process;
    dieWith(server);
    ::dup2(conversation.get(), theSocket);
    serve();
    _exit(0);
}

class Server {
public:
    explicit Server(const std::function<void()>& serve) : serve_(serve), self_(::getpid()) {}

    /// Until nobody can ask any more.
    void work() {
        for (;;) {
            constexpr int tick = 5; // ms between two looks for readers that have ended
            std::vector<pollfd> polled{{theSocket, POLLIN, 0}};
            for (const Watched& watched : watched_) polled.push_back({watched.report.get(), POLLIN, 0});
            if (::poll(polled.data(), polled.size(), watched_.empty() ? -1 : tick) < 0) continue;
            for (std::size_t i = watched_.size(); i-- > 0;)
                if (watched_[i].hasEnded(polled[i + 1].revents != 0))
                    watched_.erase(watched_.begin() + static_cast<std::ptrdiff_t>(i));
            if (polled.front().revents != 0 && !takeRequest()) return;
        }
    }

private:
    bool takeRequest() {
        auto handed = takeDescriptors(theSocket);
        if (!handed) return false;
        std::vector<Descriptor>& ends = handed->second;
        if (ends.size() != 2) return true;
        const pid_t reader = forkReader(self_, ends[0], serve_);
        if (reader > 0) watched_.push_back({reader, std::move(ends[1])}); // else the parent sees both closed
        return true;
    }

    const std::function<void()>& serve_;
    const pid_t self_;
    std::vector<Watched> watched_;
};

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
    ::prctl(PR_SET_PDEATHSIG, 0); // the thread that started us may end before its process
    Server(serve).work();
    _exit(0);
}

} // namespace shadowbench
