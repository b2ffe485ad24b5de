#include "tools/faults/supervised.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "tools/faults/notifications.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace shadowbench::faults {
namespace {

using Clock = std::chrono::steady_clock;

std::string reason(int error) { return std::generic_category().message(error); }

/// Sends a descriptor, or errno where it is −1.
void sendDescriptor(int socket, int descriptor) {
    int error = descriptor < 0 ? errno : 0;
    iovec bytes{&error, sizeof error};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof descriptor)> control{};
    msghdr message{};
    message.msg_iov = &bytes;
    message.msg_iovlen = 1;
    if (descriptor >= 0) {
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof descriptor);
        std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
    }
    sendmsg(socket, &message, 0);
}

Descriptor receiveDescriptor(int socket) {
    int error = EPROTO, descriptor = -1;
    iovec bytes{&error, sizeof error};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof descriptor)> control{};
    msghdr message{};
    message.msg_iov = &bytes;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    if (const cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr)
        std::memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
    if (descriptor < 0) throw Inconclusive("this system lets no program be supervised (seccomp): " + reason(error));
    return Descriptor(descriptor);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (std::string& text : texts) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

std::pair<Descriptor, Descriptor> makePipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Inconclusive("cannot make a pipe: " + reason(errno));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// Kills the children of this process, which orphans are as well; how many there were.
int killChildren() {
    std::ifstream list(fmt::format("/proc/self/task/{}/children", gettid()));
    int killed = 0;
    for (pid_t child = 0; list >> child; ++killed) kill(child, SIGKILL);
    return killed;
}

class Supervision {
public:
    Supervision(const Job& job, const Decide& decide) : job_(job), decide_(decide), end_(Clock::now() + job.limit) {
        prctl(PR_SET_CHILD_SUBREAPER, 1);
        start();
    }
    ~Supervision() {
        listener_.close(); // calls that wait for a decision fail
        while (killChildren() > 0)
            while (waitpid(-1, nullptr, WNOHANG) > 0) {
            }
        prctl(PR_SET_CHILD_SUBREAPER, 0);
    }
    Supervision(const Supervision&) = delete;
    Supervision& operator=(const Supervision&) = delete;

    Ended toTheEnd() {
        while (step()) {
        }
        drain(output_, ended_.output);
        drain(errors_, ended_.errors);
        return std::move(ended_);
    }

private:
    void start() {
        auto [socket, socketEnd] = makeSockets();
        auto [output, outputEnd] = makePipe();
        auto [errors, errorsEnd] = makePipe();
        std::vector<std::string> words{job_.program.string()}, variables = job_.variables;
        words.insert(words.end(), job_.arguments.begin(), job_.arguments.end());
        const std::vector<char*> argv = pointers(words), envp = pointers(variables);
        root_ = fork();
        if (root_ < 0) throw Inconclusive("cannot start a program: " + reason(errno));
        if (root_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            const int nothing = open("/dev/null", O_RDONLY);
            dup2(nothing, STDIN_FILENO);
            dup2(outputEnd.get(), STDOUT_FILENO);
            dup2(errorsEnd.get(), STDERR_FILENO);
            if (chdir(job_.folder.c_str()) != 0) _exit(126);
            sendDescriptor(socketEnd.get(), installFilter());
            execve(argv[0], argv.data(), envp.data());
            _exit(126);
        }
        socketEnd.close();
        output_ = std::move(output);
        errors_ = std::move(errors);
        for (const Descriptor* end : {&output_, &errors_}) fcntl(end->get(), F_SETFL, O_NONBLOCK);
        listener_ = receiveDescriptor(socket.get());
    }

    /// False once everything has ended.
    bool step() {
        std::array<pollfd, 3> watched{pollfd{listener_.get(), POLLIN, 0}, pollfd{output_.get(), POLLIN, 0},
                                      pollfd{errors_.get(), POLLIN, 0}};
        constexpr int tick = 5; // milliseconds
        poll(watched.data(), watched.size(), tick);
        if ((watched[0].revents & POLLIN) != 0) decideNext();
        drain(output_, ended_.output);
        drain(errors_, ended_.errors);
        reap();
        if (none_) return false;
        const Clock::time_point now = Clock::now();
        if (rootEnd_ && now > *rootEnd_ + job_.patience) ended_.strays = std::max(ended_.strays, killChildren());
        if (!rootEnd_ && now > end_) {
            ended_.late = true;
            killChildren();
        }
        return true;
    }

    void decideNext() {
        const auto notification = nextNotification(listener_.get());
        if (!notification) return;
        const auto call = callOf(listener_.get(), *notification, job_.program);
        Decision decision;
        if (call) {
            ++ended_.calls;
            decision = decide_(*call, root_);
        }
        if (decision.signal != 0) {
            kill(decision.whom, decision.signal);
            std::this_thread::sleep_for(
                std::chrono::milliseconds(10)); // one that ends by it does so before the call goes on
        }
        answer(listener_.get(), *notification, decision.error);
    }

    void reap() {
        int status = 0;
        pid_t process = 0;
        while ((process = waitpid(-1, &status, WNOHANG)) > 0) {
            if (process != root_) continue;
            ended_.code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
            rootEnd_ = Clock::now();
        }
        none_ = process < 0 && errno == ECHILD;
    }

    static void drain(const Descriptor& from, std::string& into) {
        std::array<char, 8192> buffer{};
        for (ssize_t count = 0; (count = read(from.get(), buffer.data(), buffer.size())) > 0;)
            into.append(buffer.data(), static_cast<std::size_t>(count));
    }

    const Job& job_;
    const Decide& decide_;
    Clock::time_point end_;
    pid_t root_ = -1;
    Descriptor listener_{-1}, output_{-1}, errors_{-1};
    std::optional<Clock::time_point> rootEnd_;
    bool none_ = false;
    Ended ended_;
};

} // namespace

std::string_view name(Kind kind) {
    switch (kind) {
    case Kind::Open:
        return "open";
    case Kind::Write:
        return "write";
    case Kind::Rename:
        return "rename";
    case Kind::Fsync:
        return "fsync";
    case Kind::Fork:
        return "fork";
    case Kind::Thread:
        return "thread";
    case Kind::Pipe:
        return "pipe";
    }
    return "";
}

bool canSupervise() {
    try {
        const Job job{.program = "/bin/true", .arguments = {}, .folder = "/", .variables = {}};
        return supervise(job, [](const Call&, pid_t) { return Decision{}; }).code == 0;
    } catch (const Inconclusive&) {
        return false;
    }
}

Ended supervise(const Job& job, const Decide& decide) { return Supervision(job, decide).toTheEnd(); }

} // namespace shadowbench::faults
