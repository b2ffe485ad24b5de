#include "gate/check/client.h"

#include "base/interrupts.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "gate/check/client_scenes.h"
#include "gate/check/mistakes.h"
#include "gate/check/scattered_errors.h"
#include "gate/check/watched_files.h"
#include "groundtruth/oracle.h"
#include "groundtruth/store/cache.h"
#include "harness/foreign/call_renderer.h"
#include "harness/foreign/recognition.h"
#include "harness/foreign/renderer.h"
#include "harness/foreign/score_images.h"
#include "harness/foreign/visibility.h"
#include "scene/exchange/export.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <optional>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using foreign::Definition;
using foreign::Renderer;
using groundtruth::Reference;
using groundtruth::Surface;
using groundtruth::Truth;

constexpr double notable =
    0.004; // share of wrong labels that a mistake explains, not a filter's edges: half a pixel's shift
constexpr double explained = 0.2;  // of the error may be left by the mistake that is named …
constexpr double leftMost = 0.05;  // … and of the labels
constexpr double tolerated = 0.06; // share of wrong labels, or rms error, of a map that is none too fine

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

Truth truthOf(Definition definition) {
    switch (definition) {
    case Definition::Hard:
        return Truth::Hard;
    case Definition::Area:
        return Truth::Area;
    case Definition::Irradiance:
        return Truth::Irradiance;
    case Definition::SolidAngle:
        return Truth::SolidAngle;
    }
    throw InternalError("images of an unknown meaning");
}

foreign::Pixels receiversOf(const Reference& truth) {
    foreign::Pixels scored(truth.surface.width(), truth.surface.height());
    for (std::size_t i = 0; i < scored.size(); ++i) scored[i] = truth.surface[i] == Surface::Receiver ? 1 : 0;
    return scored;
}

/// What is true of a scene's frames, and what mistakes would draw: computed when first asked for.
class KnownScene {
public:
    explicit KnownScene(Scene scene) : scene_(std::move(scene)), frames_(shadowbench::scoredFrames(scene_)) { exportAnew(); }

    void exportAnew() {
        fs::remove_all(exported());
        exchange::exportScene(scene_, exported());
    }

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<int>& frames() const { return frames_; }
    [[nodiscard]] fs::path exported() const { return folder_.path() / "scene"; }

    const Reference& truth(Truth truth, int frame) {
        const auto key = std::pair(truth, frame);
        if (const auto known = truths_.find(key); known != truths_.end()) return known->second;
        return truths_.emplace(key, groundtruth::compute({snapshot(scene_, frame), scene_.size, truth})).first->second;
    }

    /// Mistakes that no image could be compared with: their sentences, each with the reason.
    [[nodiscard]] const std::map<std::string, std::string>& unknown() const { return unknown_; }

    /// Nothing where the mistake changes nothing or leaves nothing to see.
    const std::optional<Reference>& with(const Mistake& mistake, int frame) {
        const auto key = std::pair(&mistake, frame);
        if (const auto known = mistaken_.find(key); known != mistaken_.end()) return known->second;
        return mistaken_.emplace(key, computed(mistake, frame)).first->second;
    }

private:
    std::optional<Reference> computed(const Mistake& mistake, int frame) {
        const auto taken = mistake.taken(snapshot(scene_, frame), snapshot(scene_, frames_.front()), scene_.size);
        if (!taken || taken->batches.empty()) return {};
        try {
            return groundtruth::compute({*taken, scene_.size, Truth::Hard});
        } catch (const Error& error) { // a light in a surface, say: no picture has such a truth
            unknown_.emplace(mistake.sentence, error.what());
            return {};
        }
    }

    Scene scene_;
    std::vector<int> frames_;
    TemporaryFolder folder_;
    std::map<std::pair<Truth, int>, Reference> truths_;
    std::map<std::pair<const Mistake*, int>, std::optional<Reference>> mistaken_;
    std::map<std::string, std::string> unknown_;
};

/// One frame that a renderer drew.
struct Drawing {
    const Renderer& renderer;
    KnownScene& known;
    int frame;
    const Image<float>& v;
    const Reference& truth; // of the renderer's definition
    foreign::Pixels scored;
    [[nodiscard]] bool labels() const { return renderer.definition == Definition::Hard; }
    [[nodiscard]] foreign::Compared compared() const { return {v, truth.visibility, scored, labels()}; }
};

/// What a mistake draws, where nothing is seen `background`.
Image<float> drawnWith(const Reference& mistaken, float background) {
    Image<float> v = mistaken.visibility;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (mistaken.surface[i] == Surface::Background) v[i] = background;
    return v;
}

/// Whether the image has light and shadow: many mistakes draw one of them alone.
bool isTelling(const Drawing& drawing) {
    double dark = 0, lit = 0;
    for (std::size_t i = 0; i < drawing.v.size(); ++i)
        if (drawing.scored[i] != 0) (drawing.v[i] < 0.5F ? dark : lit) += 1;
    return std::min(dark, lit) > 0.01 * (dark + lit);
}

/// The error against what a mistake would have drawn. What a renderer has where it sees nothing is its own business.
double errorWith(const Drawing& drawing, const Reference& mistaken) {
    double least = 1;
    for (const float background : {0.0F, 1.0F})
        least = std::min(least, foreign::errorOf({drawing.v, drawnWith(mistaken, background), drawing.scored, true}));
    return least;
}

std::string mistakeIn(const Drawing& drawing) {
    const double error = foreign::errorOf(drawing.compared());
    if (!drawing.labels() || error < notable || !isTelling(drawing)) return "";
    double least = std::min(explained * error, leftMost);
    std::string found;
    for (const Mistake& mistake : mistakes()) {
        const std::optional<Reference>& mistaken = drawing.known.with(mistake, drawing.frame);
        if (!mistaken) continue;
        const double left = errorWith(drawing, *mistaken);
        if (left >= least) continue;
        least = left;
        found =
            fmt::format("{}: {} of the pixels are wrong, and {} with that", mistake.sentence, percent(error), percent(left));
    }
    return found;
}

/// What may be behind an image that is the same everywhere; nothing of others.
std::string causeOfOneGrey(const Drawing& drawing) {
    if (!foreign::uniform(drawing.compared())) return "";
    const bool isLit = std::ranges::any_of(drawing.v, [](float v) { return v > 0.5F; });
    return isLit ? "; is its light at the eye, or do its shadows end before the scene begins?"
                 : "; is its light behind everything?";
}

std::string oddityIn(const Drawing& drawing) {
    std::vector<foreign::OtherFrame> others;
    const Truth truth = truthOf(drawing.renderer.definition);
    for (const int frame : drawing.known.frames())
        if (frame != drawing.frame) others.push_back({frame, drawing.known.truth(truth, frame).visibility});
    for (const foreign::Finding& finding : foreign::oddities(drawing.compared(), drawing.renderer.encoding, others))
        return fmt::format("its image {}{}", finding.sentence, causeOfOneGrey(drawing));
    return "";
}

/// The median of the visibilities where the truth is `visibility`, away from edges.
std::optional<double> medianWhere(const Drawing& drawing, float visibility) {
    std::vector<float> values;
    for (std::size_t i = 0; i < drawing.v.size(); ++i) {
        const bool inside = !drawing.labels() || drawing.truth.edgeDistance[i] > 2;
        if (drawing.scored[i] != 0 && drawing.truth.visibility[i] == visibility && inside) values.push_back(drawing.v[i]);
    }
    if (values.size() < 64) return {}; // pixels: of fewer, odd ones may be half
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return static_cast<double>(*middle);
}

std::string remainingLightIn(const Drawing& drawing) {
    const auto dark = medianWhere(drawing, 0), lit = medianWhere(drawing, 1);
    if (!dark || !lit || *dark < 0.05 || *dark > 0.95 || *lit - *dark < 0.05) return "";
    return fmt::format("{} of the light is left in its shadows: ambient light or a second light is in the image, which "
                       "frame-…-lit and frame-…-unlit take out, or a filter leaks",
                       percent(*dark));
}

std::string definitionIn(const Drawing& drawing) {
    if (drawing.labels()) return "";
    const double error = foreign::errorOf(drawing.compared());
    double least = error / 2;
    std::string found;
    for (const Definition definition : foreign::allDefinitions) {
        if (definition == drawing.renderer.definition) continue;
        const Reference& other = drawing.known.truth(truthOf(definition), drawing.frame);
        const double left = foreign::errorOf({drawing.v, other.visibility, drawing.scored, false});
        if (left >= least || error < 0.02) continue;
        least = left;
        found = fmt::format("its images are of the definition \"{}\", not \"{}\": the rms error falls from {:.2g} to {:.2g}",
                            name(definition), name(drawing.renderer.definition), error, left);
    }
    return found;
}

/// What is wrong and nothing above explains.
std::string errorIn(const Drawing& drawing) {
    const double error = foreign::errorOf(drawing.compared());
    if (error <= tolerated) return "";
    if (!drawing.labels()) return fmt::format("its rms error is {:.2g}, and no mistake that is known explains it", error);
    double dark = 0, lit = 0;
    for (std::size_t i = 0; i < drawing.v.size(); ++i) {
        if (drawing.scored[i] == 0) continue;
        const bool isLit = drawing.v[i] >= 0.5F, shouldBe = drawing.truth.visibility[i] >= 0.5F;
        (shouldBe ? dark : lit) += isLit != shouldBe ? 1 : 0;
    }
    const char* cause =
        dark > 3 * lit   ? "most of these are dark and should be lit: lit faces shadow themselves (a bias that is "
                           "too small or of the wrong sign), or casters are too large"
        : lit > 3 * dark ? "most of these are lit and should be dark: casters are missing, or the bias is too large"
                         : "no mistake that is known explains it";
    return fmt::format("{} of the pixels are wrong; {}", percent(error), cause);
}

/// What is wrong with a frame; the first that explains it.
std::string wrongWith(const Drawing& drawing) {
    for (const auto& look : {remainingLightIn, mistakeIn, definitionIn, oddityIn, errorIn})
        if (std::string wrong = look(drawing); !wrong.empty()) return wrong;
    return "";
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
    ClientCheck(std::vector<Renderer> renderers, const OnResult& onResult)
        : renderers_(std::move(renderers)), onResult_(onResult), own_(renderers_.front().folder) {}

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
            tell({what, call.wrong, call.wrong.empty() ? fmt::format("{}; {:.1f} s", error, took.count()) : ""});
        } catch (const InternalError&) {
            throw;
        } catch (const Error& error) {
            if (DeferredInterrupts::pending()) throw;
            tellOnce(renderer, known.scene(), {what, error.what()});
        }
    }

    void tell(const CheckResult& result) {
        hold_ = hold_ && result.wrong.empty();
        onResult_(result);
    }

    /// A command that fails on each scene for one reason, such as a set-up that is missing, says it for the first.
    void tellOnce(const Renderer& renderer, const Scene& scene, const CheckResult& result) {
        auto& [said, others] = failures_[renderer.id];
        if (said == result.wrong) {
            others.push_back(scene.id);
            return;
        }
        said = result.wrong;
        tell(result);
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
    const OnResult& onResult_;
    WatchedFiles own_;
    std::map<std::string, std::vector<ErrorPlaces>> places_; // by row, one of each scene
    std::map<std::string, std::pair<std::string, std::vector<std::string>>>
        failures_; // by row: what, and on which scenes again
    bool hold_ = true;
};

} // namespace

ExitCode checkRenderers(const fs::path& file, const std::function<void(const CheckResult&)>& onResult) {
    return ClientCheck(foreign::readRenderers(file), onResult).run();
}

} // namespace shadowbench::gate
