#include "gate/check/client.h"

#include "base/interrupts.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "gate/check/client_scenes.h"
#include "gate/check/drawing.h"
#include "gate/check/scattered_errors.h"
#include "gate/check/watched_files.h"
#include "groundtruth/oracle.h"
#include "groundtruth/store/cache.h"
#include "harness/foreign/call_renderer.h"
#include "harness/foreign/expected_failures.h"
#include "harness/foreign/renderer.h"
#include "harness/foreign/score_images.h"
#include "harness/foreign/visibility.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using foreign::Definition;
using foreign::ExpectedFailure;
using foreign::Renderer;
using groundtruth::Reference;
using groundtruth::Surface;
using groundtruth::Truth;

foreign::Pixels receiversOf(const Reference& truth) {
    foreign::Pixels scored(truth.surface.width(), truth.surface.height());
    for (std::size_t i = 0; i < scored.size(); ++i) scored[i] = truth.surface[i] == Surface::Receiver ? 1 : 0;
    return scored;
}

/// What is seen of one call.
struct Call {
    std::string wrong;       // of its images; empty: nothing
    double error = 0;        // of the worst frame
    ErrorPlaces places = {}; // of hard rows
};

void requireNothingWritten(const WatchedFiles& files, const fs::path& folder, const char* where) {
    const std::vector<fs::path> changed = files.changed();
    if (changed.empty()) return;
    throw Inconclusive(
        fmt::format("it wrote outside its {{out}}: {}{}", where, changed.front().lexically_relative(folder).string()));
}

/// Another process may use entries meanwhile, or store some, but leaves none that is damaged.
void requireIntactCache(const WatchedFiles& files, const groundtruth::Cache& cache) {
    const std::vector<fs::path> changed = files.changed();
    if (changed.empty()) return;
    for (const groundtruth::CacheEntry& entry : cache.entries())
        if (std::ranges::binary_search(changed, entry.file) && groundtruth::damage(entry))
            throw Inconclusive(fmt::format("it wrote outside its {{out}}: {}, a truth of shadowbench", entry.file.string()));
}

foreign::Rendered calledAlone(KnownScene& known, const Renderer& renderer, const fs::path& out) {
    std::vector<int> frames = known.frames();
    if (!renderer.moving) frames.resize(1);
    const groundtruth::Cache cache(groundtruth::defaultCacheFolder());
    const WatchedFiles scene(known.exported()), truths(cache.folder());
    foreign::Rendered rendered = foreign::callRenderer(renderer, known.exported(), frames, out, ownEnvironment());
    try {
        requireNothingWritten(scene, known.exported(), "the exported scene's ");
        requireIntactCache(truths, cache);
    } catch (const Inconclusive&) {
        known.exportAnew();
        throw;
    }
    return rendered;
}

Call callOn(KnownScene& known, const Renderer& renderer) {
    const TemporaryFolder out;
    const foreign::Rendered rendered = calledAlone(known, renderer, out.path());
    Call call;
    for (const foreign::FrameFiles& files : rendered.frames) {
        const Reference& truth = known.truth(truthOf(renderer.definition), files.frame);
        const foreign::Pixels scored = receiversOf(truth);
        std::vector<std::string> warnings;
        const foreign::Visibility visibility = foreign::visibilityOf(
            files, {.size = known.scene().size, .encoding = renderer.encoding, .channel = renderer.channel}, scored,
            warnings);
        const Drawing drawing{renderer, known, files.frame, visibility.v, truth, scored};
        call.error = std::max(call.error, foreign::errorOf(drawing.compared()));
        if (drawing.labels()) addErrors(visibility.v, truth, call.places);
        if (const std::string wrong = wrongWith(drawing); !wrong.empty() && call.wrong.empty())
            call.wrong = rendered.frames.size() > 1 ? fmt::format("frame {}: {}", files.frame, wrong) : wrong;
    }
    return call;
}

bool fits(const Scene& scene, const Renderer& renderer) {
    return renderer.draws(scene.light.kind) && groundtruth::hasTruth(scene.light, truthOf(renderer.definition));
}

/// Each row on each scene, and what is told once at the end.
class ClientCheck {
public:
    using OnResult = std::function<void(const CheckResult&)>;
    ClientCheck(const fs::path& file, const OnResult& onResult)
        : renderers_(foreign::readRenderers(file)), expected_(foreign::readExpectedFailures(file)), onResult_(onResult),
          own_(renderers_.front().folder) {
        for (const ExpectedFailure& failure : expected_) requireRow(failure);
    }

    ExitCode run() {
        for (Scene& scene : clientScenes()) {
            KnownScene known(std::move(scene));
            for (const Renderer& renderer : renderers_)
                if (fits(known.scene(), renderer)) judge(known, renderer);
            noteUnknown(known);
        }
        for (const Renderer& renderer : renderers_) noteRow(renderer);
        noteOwnFolder();
        return hold_ ? ExitCode::Pass : ExitCode::AccuracyRegression;
    }

private:
    /// That some row is called on its scene.
    void requireRow(const ExpectedFailure& failure) const {
        std::vector<std::string> ids;
        for (const Scene& scene : clientScenes()) {
            ids.push_back(scene.id);
            for (const Renderer& renderer : renderers_)
                if (failure.covers(scene.id, renderer.id) && fits(scene, renderer)) return;
        }
        throw BadInput(fmt::format("{}: no renderer {} is called on a scene \"{}\"; the scenes are {}", failure.where,
                                   fmt::join(failure.renderers, ", "), failure.scene, fmt::join(ids, ", ")));
    }

    void judge(KnownScene& known, const Renderer& renderer) {
        const std::string what = fmt::format("{} on {}", renderer.id, known.scene().id);
        const auto before = std::chrono::steady_clock::now();
        try {
            const Call call = callOn(known, renderer);
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
            if (renderer.definition == Definition::Hard) places_[renderer.id].push_back(call.places);
            const std::string error = renderer.definition == Definition::Hard
                                          ? percent(call.error) + " of the pixels are wrong"
                                          : fmt::format("the rms error is {:.2g}", call.error);
            onResult_(
                judged(renderer, known.scene(),
                       {what, call.wrong, call.wrong.empty() ? fmt::format("{}; {:.1f} s", error, took.count()) : ""}));
        } catch (const InternalError&) {
            throw;
        } catch (const Error& error) {
            if (DeferredInterrupts::pending()) throw;
            tellFailure(renderer, known.scene(), judged(renderer, known.scene(), {what, error.what()}));
        }
    }

    /// With what the file expects of the row there.
    CheckResult judged(const Renderer& renderer, const Scene& scene, CheckResult result) {
        const auto known = std::ranges::find_if(
            expected_, [&](const ExpectedFailure& failure) { return failure.covers(scene.id, renderer.id); });
        if (known != expected_.end()) {
            result.isExpected = result.wrong.find(known->says) != std::string::npos;
            if (result.isExpected)
                result.note = known->reason;
            else if (result.wrong.empty())
                result.wrong = fmt::format("it holds, and {} expects that it fails: {}; take the entry away", known->where,
                                           known->reason);
            else
                result.wrong += fmt::format("; {} expects another failure: \"{}\"", known->where, known->says);
        }
        hold_ = hold_ && (result.wrong.empty() || result.isExpected);
        return result;
    }

    /// A command that fails on each scene for one reason, such as a set-up that is missing, says it for the first.
    void tellFailure(const Renderer& renderer, const Scene& scene, const CheckResult& result) {
        auto& [said, others] = failures_[renderer.id];
        if (said == result.wrong) {
            others.push_back(scene.id);
            return;
        }
        said = result.wrong;
        onResult_(result);
    }

    void noteUnknown(const KnownScene& known) {
        if (known.unknown().empty()) return;
        const auto& [sentence, reason] = *known.unknown().begin();
        onResult_(
            {"", "",
             fmt::format("{} of the {} mistakes were not looked for on {}, as no truth of them can be computed; \"{}\": {}",
                         known.unknown().size(), mistakes().size(), known.scene().id, sentence, reason)});
    }

    void noteRow(const Renderer& renderer) {
        if (const auto& others = failures_[renderer.id].second; !others.empty())
            onResult_({"", "", fmt::format("{} fails in the same way on {}", renderer.id, fmt::join(others, ", "))});
        if (lieAtRandom(places_[renderer.id]))
            onResult_({"", "",
                       fmt::format("{}: its errors lie at random, not at edges: the images are not a rasteriser's, but look "
                                   "like the truth with noise",
                                   renderer.id)});
    }

    void noteOwnFolder() {
        const std::vector<fs::path> written = own_.changed();
        if (written.empty()) return;
        const fs::path& folder = renderers_.front().folder;
        onResult_({"", "",
                   fmt::format("{} {} written in {} meanwhile: {}{}; images must follow from the exported scene alone",
                               written.size(), written.size() > 1 ? "files were" : "file was", folder.string(),
                               written.front().lexically_relative(folder).string(), written.size() > 1 ? ", …" : "")});
    }

    std::vector<Renderer> renderers_;
    std::vector<ExpectedFailure> expected_;
    const OnResult& onResult_;
    WatchedFiles own_;
    std::map<std::string, std::vector<ErrorPlaces>> places_; // by row, one of each scene
    std::map<std::string, std::pair<std::string, std::vector<std::string>>>
        failures_; // by row: what, and on which scenes again
    bool hold_ = true;
};

} // namespace

ExitCode checkRenderers(const fs::path& file, const std::function<void(const CheckResult&)>& onResult) {
    return ClientCheck(file, onResult).run();
}

} // namespace shadowbench::gate
