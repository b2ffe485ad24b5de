// What the certificates of soft truths refuse: POV-Ray with a fault in its lights, on every frame that is scored of the
// scenes named, and how honest renders fare there: those of other sample sets, by the N-sample oracle and by POV-Ray.
//
//   build/release/benchmarks/truth_faults --scene simple --scene overlapping-occluders [--seeds 200] [--frame 59]
#include "base/error.h"
#include "base/temporary_folder.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/store/golden.h"
#include "harness/cells/truths.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "tests/support/honest_seeds.h"
#include "tests/support/povray_wrapper.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench::groundtruth {
namespace {

struct Options {
    std::vector<std::string> scenes;
    std::vector<int> frames; // empty: the last still one and the last moving one
    int seeds = 200, renders = 5;
    bool locked = false;
};

std::string refusal(const Certificate& certificate, int samples) {
    try {
        requireCertified(certificate, samples);
        return "certified";
    } catch (const Inconclusive& error) {
        const std::string text = error.what();
        const std::size_t from = text.find("rejected: ") + 10;
        return "refused: " + text.substr(from, text.find(';', from) - from);
    }
}

/// One frame's request with what is prepared of it.
class Judge {
public:
    explicit Judge(Request request)
        : request_(std::move(request)), triangles_(std::make_shared<const geometry::SceneTriangles>(request_.snapshot)),
          primary_(hard::ExactScene(request_.snapshot, triangles_, availableThreads()).primaryHits(request_.size)),
          scene_(request_.snapshot, triangles_, availableThreads()) {}

    [[nodiscard]] povray::Render render(Wrapper wrapper) const {
        const TemporaryFolder folder;
        povray::Options options;
        options.threads = availableThreads();
        options.program = writeWrapper(folder.path(), wrapper, request_.snapshot.light, request_.samples,
                                       povray::scaleOf(request_.snapshot));
        return povray::render(request_.snapshot, request_.size, request_.samples, options);
    }

    [[nodiscard]] Certificate certificate(const povray::Render& image) const {
        return certify(scene_, request_, image, primary_, certificatePointCount, availableThreads());
    }

    void printHonest(const povray::Render& image, int seeds) const {
        const auto start = std::chrono::steady_clock::now();
        const Certificate c = certificate(image);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        fmt::print("  honest: {} ({:.2f} s); {} points, {} in the penumbra; replayed {:.4f}\n", refusal(c, request_.samples),
                   seconds, c.points, c.penumbra, c.replayed);
        if (!c.honest) return;
        fmt::print("    bias {:+.6f} (at most {:.6f}), rms {:.6f} (at most {:.6f}), fall {:.3f} (at most {:.3f})\n", c.bias,
                   c.honest->bias, c.rms, c.honest->rms, c.rms / c.rmsQuarter, c.honest->fall);
        const std::vector<Certificate> others = certificatesOfSeeds(
            scene_, request_, primary_, certificatePoints(image, primary_, certificatePointCount), *c.honest, seeds);
        const auto passed =
            std::ranges::count_if(others, [&](const Certificate& o) { return refusal(o, request_.samples) == "certified"; });
        fmt::print("    other seeds: {} of {} certified\n", passed, seeds);
    }

    /// Renders of POV-Ray's with other sample sets, each certified as what it is made of.
    void printOtherSets(int sets) const {
        int passed = 0;
        for (int set = 1; set <= sets; ++set) {
            const TemporaryFolder folder;
            povray::Options options;
            options.threads = availableThreads();
            options.program = writeWrapperOfSet(folder.path(), request_.snapshot.light, request_.samples,
                                                povray::scaleOf(request_.snapshot), static_cast<std::uint32_t>(set));
            const povray::Render image = povray::render(request_.snapshot, request_.size, request_.samples, options);
            const Certificate c = certify(scene_, request_, image, primary_, certificatePointCount, availableThreads(), {},
                                          static_cast<std::uint32_t>(set));
            passed += refusal(c, request_.samples) == "certified" ? 1 : 0;
        }
        fmt::print("    other seeds by POV-Ray: {} of {} certified\n", passed, sets);
    }

    void printFault(Wrapper wrapper, const povray::Render& honest) const {
        const povray::Render image = render(wrapper);
        Certificate c = certificate(image);
        const bool same = std::ranges::equal(image.visible, honest.visible);
        fmt::print("  {}: {}{}\n", name(wrapper), refusal(c, request_.samples), same ? " (the same image)" : "");
        fmt::print("    replayed {:.3f}, bias {:+.6f}, rms {:.6f}, fall {:.3f}", c.replayed, c.bias, c.rms,
                   c.rms / c.rmsQuarter);
        c.replayed = 0;
        fmt::print("; without the replay {}\n", refusal(c, request_.samples));
    }

private:
    Request request_;
    std::shared_ptr<const geometry::SceneTriangles> triangles_;
    PrimaryHits primary_;
    area::AreaScene scene_;
};

/// What a run says of the soft truth that the wrapped POV-Ray, found on the path, renders without a cache.
std::string refusalOfRun(const Scene& scene, int frame, Wrapper wrapper) {
    const TemporaryFolder folder;
    const Request request = referenceRequest(scene, Truth::Soft, frame);
    writeWrapper(folder.path(), wrapper, request.snapshot.light, request.samples, povray::scaleOf(request.snapshot));
    const std::string path = std::getenv("PATH");
    setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
    std::string said = "accepted";
    try {
        const Cache cache(folder.path() / "references");
        Truths(scene, cache).at(Truth::Soft, frame);
    } catch (const Inconclusive& error) {
        said = std::string("refused: ") + error.what();
    }
    setenv("PATH", path.c_str(), 1);
    return said;
}

void judge(const std::string& id, const Options& options) {
    const Scene scene = loadScene(id, Profile::Gate, metrics::boundedMetrics());
    std::vector<int> frames = options.frames;
    if (frames.empty()) frames = {scene.timeline.still - 1, scene.timeline.frames() - 1};
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    for (const int frame : frames) {
        if (options.locked) {
            fmt::print("{} frame {}\n  {}: {}\n", id, frame, name(Wrapper::Honest),
                       refusalOfRun(scene, frame, Wrapper::Honest));
            for (const Wrapper wrapper : faultyWrappers)
                fmt::print("  {}: {}\n", name(wrapper), refusalOfRun(scene, frame, wrapper));
            std::fflush(stdout);
            continue;
        }
        const Judge judge(referenceRequest(scene, Truth::Soft, frame));
        fmt::print("{} frame {}\n", id, frame);
        const povray::Render honest = judge.render(Wrapper::Honest);
        judge.printHonest(honest, options.seeds);
        judge.printOtherSets(options.renders);
        for (const Wrapper wrapper : faultyWrappers) judge.printFault(wrapper, honest);
        std::fflush(stdout);
    }
}

} // namespace
} // namespace shadowbench::groundtruth

int main(int argc, char** argv) {
    using namespace shadowbench;
    groundtruth::Options options;
    CLI::App app("What the certificates of soft truths refuse");
    app.add_option("--scene", options.scenes, "Scene ids with area lights")->required();
    app.add_option("--frame", options.frames, "Frames (default: the last still one and the last moving one)");
    app.add_option("--seeds", options.seeds, "Other sample sets by the N-sample oracle")->capture_default_str();
    app.add_option("--renders", options.renders, "Other sample sets by POV-Ray")->capture_default_str();
    app.add_flag("--locked", options.locked, "Ask as a run does, with the golden references locked, for the faults only");
    CLI11_PARSE(app, argc, argv);
    try {
        for (const std::string& scene : options.scenes) groundtruth::judge(scene, options);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
