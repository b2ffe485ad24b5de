// A worker that renders one frame when it is asked to: three of them, of two programs, take turns so that what the machine
// does meets all alike (GATE.md, "Time").
#pragma once

#include "harness/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>

namespace shadowbench::timing {

struct WorkerJob {
    std::string scene; // id, or an absolute path
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;
};

/// The worker's half: for each line, the name of a variant, it renders a frame of it and answers with the milliseconds of
/// the process' CPU time and of wall time that it took, or "error" and a sentence. A variant that differs from the one
/// before is made and warmed up first, which is not timed. Ends with `requests`.
void answerWithTimes(const WorkerJob& job, std::istream& requests, std::ostream& answers);

struct FrameTime {
    double cpu = 0, wall = 0; // milliseconds
};

/// The other half: a running worker of the program `shadowbench`, this one's or another commit's.
class FrameWorker {
public:
    /// Throws Inconclusive when the program cannot be started.
    FrameWorker(const std::filesystem::path& shadowbench, const WorkerJob& job);
    ~FrameWorker();
    FrameWorker(FrameWorker&&) noexcept;

    /// Throws Inconclusive when the worker cannot render the variant or has ended.
    FrameTime frame(const std::string& variant);

private:
    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace shadowbench::timing
