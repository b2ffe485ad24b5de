#include "gate/check/drawing.h"

#include "base/error.h"
#include "groundtruth/oracle.h"
#include "scene/exchange/export.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

using foreign::Definition;
using groundtruth::Reference;
using groundtruth::Surface;
using groundtruth::Truth;

constexpr double notable =
    0.004; // share of wrong labels that a mistake explains, not a filter's edges: half a pixel's shift
constexpr double explained = 0.2;  // of the error may be left by the mistake that is named …
constexpr double leftMost = 0.05;  // … and of the labels
constexpr double tolerated = 0.06; // share of wrong labels, or rms error, of a map that is none too fine

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

} // namespace

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

KnownScene::KnownScene(Scene scene) : scene_(std::move(scene)), frames_(shadowbench::scoredFrames(scene_)) { exportAnew(); }

void KnownScene::exportAnew() {
    std::filesystem::remove_all(exported());
    exchange::exportScene(scene_, exported());
}

const Reference& KnownScene::truth(Truth truth, int frame) {
    const auto key = std::pair(truth, frame);
    if (const auto known = truths_.find(key); known != truths_.end()) return known->second;
    return truths_.emplace(key, groundtruth::compute({snapshot(scene_, frame), scene_.size, truth})).first->second;
}

const std::optional<Reference>& KnownScene::with(const Mistake& mistake, int frame) {
    const auto key = std::pair(&mistake, frame);
    if (const auto known = mistaken_.find(key); known != mistaken_.end()) return known->second;
    return mistaken_.emplace(key, computed(mistake, frame)).first->second;
}

std::optional<Reference> KnownScene::computed(const Mistake& mistake, int frame) {
    const auto taken = mistake.taken(snapshot(scene_, frame), snapshot(scene_, frames_.front()), scene_.size);
    if (!taken || taken->batches.empty()) return {};
    try {
        return groundtruth::compute({*taken, scene_.size, Truth::Hard});
    } catch (const Error& error) { // a light in a surface, say: no picture has such a truth
        unknown_.emplace(mistake.sentence, error.what());
        return {};
    }
}

std::string wrongWith(const Drawing& drawing) {
    for (const auto& look : {remainingLightIn, mistakeIn, definitionIn, oddityIn, errorIn})
        if (std::string wrong = look(drawing); !wrong.empty()) return wrong;
    return "";
}

} // namespace shadowbench::gate
