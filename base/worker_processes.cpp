#include "base/worker_processes.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/faults.h"
#include "base/interrupts.h"
#include "base/parallel.h"
#include "base/trace.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <poll.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

constexpr std::size_t noMore = std::numeric_limits<std::size_t>::max(); // sent instead of an item
constexpr std::chrono::milliseconds pause{200};                         // between two reports of progress
using Clock = std::chrono::steady_clock;

/// What a worker sends: this, and as many bytes of text.
struct Message {
    enum class Kind { Progress, Answer, Failure } kind = Kind::Progress;
    double done = 0;
    std::size_t length = 0;
};

/// Whether all bytes went through; they do not when the other end has closed.
bool sendAll(int fd, const void* bytes, std::size_t count) {
    const char* next = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t sent = send(fd, next, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        next += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receiveAll(int fd, void* bytes, std::size_t count) {
    char* next = static_cast<char*>(bytes);
    while (count > 0) {
        const ssize_t received = recv(fd, next, count, 0);
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) return false;
        next += received;
        count -= static_cast<std::size_t>(received);
    }
    return true;
}

bool sendMessage(int socket, Message message, std::string_view text) {
    message.length = text.size();
    return sendAll(socket, &message, sizeof message) && sendAll(socket, text.data(), text.size());
}

int socketOfWorker = -1; // -1: this process is none

/// Text that a worker writes and its parent reads, whatever becomes of the worker.
class SharedText {
public:
    SharedText() {
        void* shared = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (shared != MAP_FAILED) text_ = static_cast<char*>(shared); // zeros; without it nothing is told
    }
    ~SharedText() {
        if (text_ != nullptr) munmap(text_, size);
    }
    SharedText(const SharedText&) = delete;
    SharedText& operator=(const SharedText&) = delete;

    void write(std::string_view text) {
        if (text_ != nullptr) text_[text.copy(text_, size - 1)] = '\0'; // the last byte stays 0
    }
    [[nodiscard]] std::string read() const { return text_ != nullptr ? text_ : ""; }

private:
    static constexpr std::size_t size = 256;
    char* text_ = nullptr;
};
SharedText* doingOfWorker = nullptr;

/// Progress that is sent now and then.
Progress progressThrough(int socket) {
    return [socket, last = Clock::time_point()](double done, std::string_view what) mutable {
        if (Clock::now() - last < pause) return;
        last = Clock::now();
        sendMessage(socket, {.done = done}, what);
    };
}

/// The worker's half: receives the numbers of items and answers each. What is thrown here ends the worker, after which it
/// clears up nothing: the copies of the parent's objects would clear up what is the parent's.
[[noreturn]] void answerItems(int socket, SharedText& doing, pid_t parent, int workers, const SharedWork& work) noexcept {
    DeferredInterrupts::startAsWorker();
    prctl(PR_SET_PDEATHSIG, SIGTERM); // not SIGKILL: the tools that it runs have folders to remove
    if (getppid() != parent) _exit(1);
    shareThreads(workers);
    socketOfWorker = socket;
    doingOfWorker = &doing;
    std::size_t item = noMore;
    while (receiveAll(socket, &item, sizeof item) && item != noMore) {
        doing.write("");
        try {
            if (!sendMessage(socket, {.kind = Message::Kind::Answer}, work.work(item, progressThrough(socket)))) break;
        } catch (const std::exception& error) {
            sendMessage(socket, {.kind = Message::Kind::Failure}, error.what());
            _exit(static_cast<int>(ExitCode::Internal));
        }
    }
    if (work.leave) work.leave();
    std::fflush(nullptr);
    _exit(0); // without what the parent would do at its end
}

class Worker {
public:
    Worker(const SharedWork& work, int workers) : Worker(work, workers, makeSockets()) {}
    ~Worker() {
        if (process_ > 0) end(SIGTERM);
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    [[nodiscard]] int socket() const { return socket_.get(); }
    [[nodiscard]] std::size_t item() const { return item_; } // that it was given last

    void give(std::size_t item, std::chrono::seconds limit) {
        item_ = item;
        limit_ = limit;
        given_ = Clock::now();
        sendAll(socket(), &item, sizeof item); // that it has ended is noticed when its answer is received
    }

    /// Until its limit; nothing where it has none.
    [[nodiscard]] std::optional<Clock::duration> left() const {
        if (limit_.count() == 0) return std::nullopt;
        return std::max(Clock::duration(0), given_ + limit_ - Clock::now());
    }

    /// Ends it, and says why.
    std::string stop() {
        end(SIGTERM);
        const std::string doing = doing_.read();
        return fmt::format("took longer than {} s{} and was ended", limit_.count(), doing.empty() ? "" : " in " + doing);
    }

    /// Waits for what it says next; nothing when it has ended.
    std::optional<std::pair<Message, std::string>> next() {
        Message message;
        if (!receiveAll(socket(), &message, sizeof message)) return std::nullopt;
        std::string text(message.length, '\0');
        if (!receiveAll(socket(), text.data(), text.size())) return std::nullopt;
        return std::pair(message, std::move(text));
    }

    /// Lets it end once it has left, and says how it did.
    std::string finish() {
        const Span span("setup", "end of a worker");
        sendAll(socket(), &noMore, sizeof noMore);
        const int status = end(0);
        return WIFSIGNALED(status) ? fmt::format("was killed by signal {}", WTERMSIG(status))
                                   : fmt::format("ended with exit code {}", WEXITSTATUS(status));
    }

private:
    Worker(const SharedWork& work, int workers, std::pair<Descriptor, Descriptor> ends) : socket_(std::move(ends.first)) {
        std::fflush(nullptr); // or what is buffered would be written by the worker as well
        const pid_t parent = getpid();
        process_ = faults::fails(faults::Point::Fork) ? -1 : fork();
        if (process_ == 0) answerItems(ends.second.get(), doing_, parent, workers, work);
        const int reason = errno;
        if (process_ < 0)
            throw InternalError("starting another process failed: " + std::generic_category().message(reason),
                                failureOf(reason));
    }

    int end(int signal) {
        int status = 0;
        if (signal != 0) kill(process_, signal);
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return status;
    }

    Descriptor socket_;
    SharedText doing_;
    pid_t process_ = -1;
    std::size_t item_ = noMore;
    std::chrono::seconds limit_{0};
    Clock::time_point given_;
};

class Sharing {
public:
    Sharing(const SharedWork& work, int workers)
        : work_(work), count_(static_cast<int>(std::min(static_cast<std::size_t>(workers), work.items))) {}

    void all() {
        for (int i = 0; i < count_; ++i) startWorker();
        while (!workers_.empty()) {
            std::vector<pollfd> watched;
            for (const auto& worker : workers_) watched.push_back({worker->socket(), POLLIN, 0});
            if (poll(watched.data(), watched.size(), untilNextLimit()) < 0) continue; // a signal that something else handles
            for (std::size_t i = watched.size(); i-- > 0;)
                if (watched[i].revents != 0)
                    listenTo(i);
                else if (workers_[i]->left() == Clock::duration(0))
                    stop(i);
        }
    }

private:
    /// Milliseconds, as poll takes them.
    [[nodiscard]] int untilNextLimit() const {
        std::optional<Clock::duration> least;
        for (const auto& worker : workers_)
            if (const auto left = worker->left(); left && (!least || *left < *least)) least = left;
        return least ? static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(*least).count()) : -1;
    }

    void startWorker() {
        workers_.push_back(std::make_unique<Worker>(work_, count_));
        giveNext(*workers_.back());
    }

    void giveNext(Worker& worker) {
        if (work_.progress) work_.progress(next_, 0, "");
        worker.give(next_, work_.limit ? work_.limit(next_) : std::chrono::seconds(0));
        ++next_;
    }

    void listenTo(std::size_t i) {
        Worker& worker = *workers_[i];
        const std::size_t item = worker.item();
        auto said = worker.next();
        const auto is = [&](Message::Kind kind) { return said && said->first.kind == kind; };
        if (is(Message::Kind::Progress)) {
            if (work_.progress) work_.progress(item, said->first.done, said->second);
            return;
        }
        if (is(Message::Kind::Answer) && next_ < work_.items) {
            giveNext(worker);
            return work_.finished(item, std::move(said->second));
        }
        std::string how = worker.finish();
        if (is(Message::Kind::Failure)) how = "failed: " + said->second;
        if (!is(Message::Kind::Answer)) return lose(i, how);
        workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
        work_.finished(item, std::move(said->second));
    }

    void stop(std::size_t i) {
        const std::string how = workers_[i]->stop();
        lose(i, how);
    }

    /// The worker has ended.
    void lose(std::size_t i, const std::string& how) {
        const std::size_t item = workers_[i]->item();
        workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
        if (next_ < work_.items) startWorker();
        work_.lost(item, how);
    }

    const SharedWork& work_;
    int count_; // of workers
    std::size_t next_ = 0;
    std::vector<std::unique_ptr<Worker>> workers_;
};

} // namespace

void shareAmongProcesses(int workers, const SharedWork& work) { Sharing(work, workers).all(); }

bool sayDoing(std::string_view what) {
    if (doingOfWorker != nullptr) doingOfWorker->write(what);
    return doingOfWorker != nullptr;
}

bool sendFailure(std::string_view sentence) {
    return socketOfWorker >= 0 && sendMessage(socketOfWorker, {.kind = Message::Kind::Failure}, sentence);
}

void checkInOwnProcess(const std::function<void()>& check, std::chrono::seconds limit) {
    std::optional<Error> failure;
    SharedWork work;
    work.items = 1;
    work.work = [&check](std::size_t, const Progress&) -> std::string { // a letter for the code, and the sentence
        const auto letter = [](ExitCode code) { return std::string(1, static_cast<char>(code)); };
        try {
            check();
            return "";
        } catch (const Error& error) {
            return letter(error.code()) + error.what();
        } catch (const std::exception& error) {
            return letter(ExitCode::Internal) + error.what();
        }
    };
    work.finished = [&failure](std::size_t, const std::string& answer) {
        if (!answer.empty()) failure.emplace(static_cast<ExitCode>(answer.front()), answer.substr(1));
    };
    work.lost = [](std::size_t, const std::string& how) {
        constexpr std::string_view failed = "failed: "; // what sendFailure says, as exceptions are answers here
        if (how.starts_with(failed)) throw BadInput(how.substr(failed.size()));
        throw InternalError("the process of a check " + how);
    };
    work.limit = [limit](std::size_t) { return limit; };
    shareAmongProcesses(1, work);
    if (failure) throw Error(*failure);
}

} // namespace shadowbench
