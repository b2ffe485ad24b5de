// A worker that renders frames when it is asked to: three of them, of two programs, take turns so that what the machine
// does meets all alike (docs/gate.md, "Time").
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

namespace shadowbench::timing {

struct WorkerJob {
    std::string scene; // id, or an absolute path
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;
    std::optional<int> cpu = {}; // the only one it runs on: cores of one machine may differ
};

/// The worker's half. Each line asks for a number of frames of a variant, "3 pcss:taps=32+32", and is answered with the
/// milliseconds of the process' CPU time and of wall time that they took together, "41.25 41.31", or with "error" and a
/// sentence. A variant that differs from the one before is made and warmed up first, which is not timed; it is kept, with
/// its history, until another is asked for. Ends with `requests`. Base and head of a gate are different commits: a change of
/// these lines makes all earlier commits useless as a base.
void answerWithTimes(const WorkerJob& job, std::istream& requests, std::ostream& answers);

struct FrameTime {
    double cpu = 0, wall = 0; // milliseconds
};

/// The other half: a running worker of the program `shadowbench`, this one's or another commit's. It runs in an environment
/// of its own (base/process.h) and fixes the rasteriser by itself, as everything that renders does.
class FrameWorker {
public:
    /// Throws Inconclusive when the program cannot be started, and where a limit on CPU time makes its clock coarse.
    FrameWorker(const std::filesystem::path& shadowbench, const WorkerJob& job);
    ~FrameWorker();
    FrameWorker(FrameWorker&&) noexcept;

    /// Makes the variant and renders until shaders are compiled, untimed. Throws Inconclusive as `frames` does.
    void warmUp(const std::string& variant);

    /// Times `count` frames together. Throws Inconclusive, naming program, scene and variant, when the worker cannot render
    /// the variant or has ended.
    FrameTime frames(const std::string& variant, int count);

private:
    FrameTime ask(const std::string& variant, int count);

    struct Running;
    std::unique_ptr<Running> running_;
};

} // namespace shadowbench::timing
