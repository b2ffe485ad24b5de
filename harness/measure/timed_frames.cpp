#include "harness/measure/timed_frames.h"

#include "base/error.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "harness/measure/warm_frames.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/gl/context.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <istream>
#include <ostream>
#include <sstream>
#include <sys/resource.h>

namespace shadowbench::timing {
namespace {

constexpr std::chrono::minutes longestAnswer{2};

double cpuMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double wallMilliseconds() {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    return Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What one line asks for.
struct Request {
    int frames = 0;
    std::string variant;
};

Request parseRequest(const std::string& line) {
    Request request;
    std::istringstream words(line);
    if (words >> request.frames >> request.variant && request.frames >= 0) return request;
    throw BadInput(fmt::format("\"{}\" does not ask for frames; write a number and a variant: \"1 sm-uniform\"", line));
}

/// The technique that was asked for last, on the scene's scored frame.
class FrameRenderer {
public:
    explicit FrameRenderer(const WorkerJob& job)
        : seed_(job.seed), scene_(loadScene(job.scene, job.profile)), stage_(scene_) {
        stage_.show(scene_.timeline.still - 1);
    }

    FrameTime timed(const Request& request) {
        if (request.variant != variant_) warmUp(request.variant);
        const double cpu = cpuMilliseconds(), wall = wallMilliseconds();
        for (int i = 0; i < request.frames; ++i) render();
        return {cpuMilliseconds() - cpu, wallMilliseconds() - wall};
    }

private:
    void warmUp(const std::string& name) {
        variant_.clear(); // until it is known to work
        const techniques::Variant variant = techniques::parseVariant(name);
        if (variant.isLod()) throw BadInput(fmt::format("{} is a level-of-detail technique: not timed in turns", name));
        technique_.reset(); // its maps make room for the next one's
        technique_ = variant.entry->make(variant.parameters);
        index_ = scene_.timeline.still;
        for (int i = 0; i < warmFrames; ++i) render();
        variant_ = name;
    }

    void render() {
        stage_.redraw();
        stage_.render(*technique_, index_++, seed_);
        gl::Context::current().finish();
    }

    std::uint32_t seed_;
    Scene scene_;
    Stage stage_;
    std::string variant_;
    std::unique_ptr<techniques::Technique> technique_;
    int index_ = 0;
};

} // namespace

void answerWithTimes(const WorkerJob& job, std::istream& requests, std::ostream& answers) {
    const auto context = gl::Context::create();
    FrameRenderer renderer(job);
    for (std::string line; std::getline(requests, line);) {
        try {
            const FrameTime time = renderer.timed(parseRequest(line));
            answers << fmt::format("{} {}\n", time.cpu, time.wall) << std::flush;
        } catch (const Error& error) {
            answers << fmt::format("error {}\n", error.what()) << std::flush;
        }
    }
}

struct FrameWorker::Running {
    std::string program, scene;
    TemporaryFolder folder;
    Dialogue dialogue;

    Running(const std::filesystem::path& shadowbench, const WorkerJob& job)
        : program(shadowbench.string()), scene(job.scene), dialogue(command(shadowbench, job)) {}

    [[nodiscard]] Command command(const std::filesystem::path& shadowbench, const WorkerJob& job) const {
        Command c{shadowbench,
                  {"time-frames", "--scene", job.scene, "--profile", std::string(name(job.profile)), "--seed",
                   std::to_string(job.seed)},
                  folder.path()};
        c.limit = longestAnswer;
        c.cpuLimit.reset(); // it would spoil the clock
        c.memoryLimit = std::uintmax_t{16} << 30U;
        c.cpu = job.cpu;
        c.inherited = techniques::inheritedVariables();
        return c;
    }

    [[noreturn]] void fail(const std::string& variant, const std::string& why) const {
        if (why.find("no verb \"time-frames\"") != std::string::npos)
            throw Inconclusive(fmt::format("{} has no verb time-frames: it was built from a commit before paired timing; "
                                           "choose a later one",
                                           program));
        throw Inconclusive(fmt::format("timing {} on scene {} with {} failed: {}", variant, scene, program, why));
    }
};

FrameWorker::FrameWorker(const std::filesystem::path& shadowbench, const WorkerJob& job)
    : running_(std::make_unique<Running>(shadowbench, job)) {
    rlimit limit{};
    if (getrlimit(RLIMIT_CPU, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) // which the worker inherits
        throw Inconclusive(
            "time in pairs needs a precise clock of CPU time, which Linux does not give to processes with a limit "
            "on it; lift the limit (ulimit -t unlimited)");
}
FrameWorker::~FrameWorker() = default;
FrameWorker::FrameWorker(FrameWorker&&) noexcept = default;

void FrameWorker::warmUp(const std::string& variant) { ask(variant, 0); }

FrameTime FrameWorker::frames(const std::string& variant, int count) {
    if (const FrameTime time = ask(variant, count); time.cpu > 0) return time;
    running_->fail(variant, "the clock of its CPU time stands still");
}

FrameTime FrameWorker::ask(const std::string& variant, int count) {
    std::string answer;
    try {
        answer = running_->dialogue.ask(fmt::format("{} {}", count, variant));
    } catch (const Inconclusive& error) {
        running_->fail(variant, error.what());
    }
    FrameTime time;
    if (std::sscanf(answer.c_str(), "%lf %lf", &time.cpu, &time.wall) == 2) return time;
    running_->fail(variant, answer.starts_with("error ") ? answer.substr(6) : "it answered \"" + answer + "\"");
}

} // namespace shadowbench::timing
