#include "harness/timing/timed_frames.h"

#include "harness/run/stage.h"
#include "harness/scene/error.h"
#include "harness/scene/process.h"
#include "harness/scene/temporary_folder.h"
#include "techniques/gl/context.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <istream>
#include <ostream>

namespace shadowbench::timing {
namespace {

constexpr int warmFrames = 2; // the first compiles shaders, the second meets what the first left
constexpr std::chrono::minutes longestAnswer{2};
constexpr std::chrono::hours longestLife{2};

double cpuMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double wallMilliseconds() {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    return Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The technique that was asked for last, on the scene's scored frame.
class FrameRenderer {
public:
    explicit FrameRenderer(const WorkerJob& job)
        : seed_(job.seed), scene_(loadScene(job.scene, job.profile)), stage_(scene_) {
        stage_.show(scene_.timeline.still - 1);
    }

    FrameTime timed(const std::string& variant) {
        if (variant != variant_) warmUp(variant);
        const double cpu = cpuMilliseconds(), wall = wallMilliseconds();
        render();
        return {cpuMilliseconds() - cpu, wallMilliseconds() - wall};
    }

private:
    void warmUp(const std::string& variant) {
        variant_.clear(); // until it is known to work
        const techniques::Variant parsed = techniques::parseVariant(variant);
        technique_ = parsed.entry->make(parsed.parameters);
        index_ = scene_.timeline.still;
        for (int i = 0; i < warmFrames; ++i) render();
        variant_ = variant;
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
    for (std::string variant; std::getline(requests, variant);) {
        try {
            const FrameTime time = renderer.timed(variant);
            answers << fmt::format("{} {}\n", time.cpu, time.wall) << std::flush;
        } catch (const Error& error) {
            answers << fmt::format("error {}\n", error.what()) << std::flush;
        }
    }
}

struct FrameWorker::Running {
    TemporaryFolder folder;
    Dialogue dialogue;

    Running(const std::filesystem::path& shadowbench, const WorkerJob& job) : dialogue(command(shadowbench, job)) {}

    [[nodiscard]] Command command(const std::filesystem::path& shadowbench, const WorkerJob& job) const {
        Command c{shadowbench,
                  {"time-frames", "--scene", job.scene, "--profile", std::string(name(job.profile)), "--seed",
                   std::to_string(job.seed)},
                  folder.path()};
        c.limit = longestAnswer;
        c.cpuLimit = longestLife;
        c.memoryLimit = std::uintmax_t{16} << 30U;
        return c;
    }
};

FrameWorker::FrameWorker(const std::filesystem::path& shadowbench, const WorkerJob& job)
    : running_(std::make_unique<Running>(shadowbench, job)) {}
FrameWorker::~FrameWorker() = default;
FrameWorker::FrameWorker(FrameWorker&&) noexcept = default;

FrameTime FrameWorker::frame(const std::string& variant) {
    const std::string answer = running_->dialogue.ask(variant);
    FrameTime time;
    if (std::sscanf(answer.c_str(), "%lf %lf", &time.cpu, &time.wall) == 2) return time;
    throw Inconclusive(fmt::format("timing a frame of {} failed: {}", variant, answer));
}

} // namespace shadowbench::timing
