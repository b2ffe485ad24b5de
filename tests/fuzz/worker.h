// Libraries that read meshes and images die of some files. So a worker reads them: a copy of this process that reads one
// input after another, and is replaced when it dies of one. This process is none the worse.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace shadowbench::fuzz {

/// What all workers of this process have come to.
struct WorkerCounts {
    std::size_t workers = 0; // that were started
    std::size_t died = 0;    // inputs that a library died of
    std::size_t stopped = 0; // inputs that took longer than they may
};
const WorkerCounts& workerCounts();

/// A number that stands for what a reader said, without the numbers in it: inputs of different ones are worth keeping.
using Reached = std::function<void(std::size_t said)>;
void onReached(Reached reached); // what is done with it

class Worker {
public:
    /// In the worker. Returns a few words about what it read; what it throws is a refusal, but for std::logic_error, which
    /// is a find.
    using Read = std::function<std::string(std::string_view input)>;

    explicit Worker(Read read);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Throws BadInput where the input is refused, where the library dies of it, and after a fifth of a second of processor
    /// time or 15 of any. Throws std::logic_error with the report where our own code is at fault (tests/fuzz/fault.h), in a
    /// new worker, too: an earlier input may have done the damage.
    void read(std::string_view input);

private:
    struct Running;
    struct Outcome;
    [[nodiscard]] Outcome tried(std::string_view input);

    Read read_;
    std::unique_ptr<Running> running_;
};

} // namespace shadowbench::fuzz
