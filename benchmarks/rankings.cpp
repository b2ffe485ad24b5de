// What the places of rows owe to the thresholds of metrics, to the size of the image, to seed and view: each ranking once as
// published and once with one of these changed. Prints a table in Markdown (docs/metrics.md, "What rankings owe to
// choices").
//
//   build/release/benchmarks/rankings [--scene simple] [--technique 'pcss*']
#include "base/error.h"
#include "harness/cells/cell.h"
#include "harness/cells/changed_scene.h"
#include "harness/cells/image_scores.h"
#include "harness/metrics/thresholds.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

using metrics::ScoredFrame;
using metrics::Thresholds;

constexpr std::uint32_t firstSeed = 1, seeds = 8;
constexpr int views = 5;

using Score = std::function<std::optional<double>(const ScoredFrame&)>;

/// A ranking as published, and with a choice changed.
struct Question {
    std::string metric, change;
    Score published, changed;
};

/// With labels that are lit from V ≥ `least` on, where published ones are from ½ on.
Score mismatchFrom(float least) {
    return [least](const ScoredFrame& frame) {
        Image<float> labels = frame.v;
        for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = labels[i] >= least ? 1.0F : 0.0F;
        return metrics::labelErrors({labels, frame.truth, frame.mask}).mismatch;
    };
}

using OfThresholds = std::function<std::optional<double>(const Thresholds&, const ScoredFrame&)>;

void ask(std::vector<Question>& questions, const std::string& metric, const OfThresholds& score,
         const std::vector<std::pair<std::string, Thresholds>>& changes) {
    for (const auto& [change, near] : changes)
        questions.push_back({metric, change, [score](const ScoredFrame& frame) { return score({}, frame); },
                             [score, near = near](const ScoredFrame& frame) { return score(near, frame); }});
}

template <typename Part>
OfThresholds ofEdge(Part metrics::EdgeError::*part) {
    return [part](const Thresholds& near, const ScoredFrame& frame) {
        const auto error = metrics::edgeErrorBy(near, frame);
        return error ? std::optional<double>((*error).*part) : std::nullopt;
    };
}

std::vector<Question> questionsOf(Truth graded) {
    std::vector<Question> questions;
    if (graded == Truth::Hard) {
        for (const auto& [text, least] : {std::pair{"¼", 0.25F}, std::pair{"1", 1.0F}})
            questions.push_back(
                {"mismatch", fmt::format("lit from V ≥ ½ → {}", text), mismatchFrom(0.5F), mismatchFrom(least)});
        ask(questions, "mismatch_off_edge",
            [](const Thresholds& near, const ScoredFrame& f) { return metrics::labelErrorsBy(near, f).mismatchOffEdge; },
            {{"½ px → ¼ px", {.edgePixel = 0.25}}, {"½ px → 1 px", {.edgePixel = 1}}});
        const std::vector<std::pair<std::string, Thresholds>> missing{{"8 px → 4 px", {.missingEdge = 4}},
                                                                      {"8 px → 16 px", {.missingEdge = 16}}};
        ask(questions, "edge_error.missing", ofEdge(&metrics::EdgeError::missing), missing);
        ask(questions, "edge_error.p95", ofEdge(&metrics::EdgeError::p95), missing);
        ask(questions, "edge_error.islands", ofEdge(&metrics::EdgeError::islands),
            {{"2 px → 1 px", {.island = 1}}, {"2 px → 4 px", {.island = 4}}});
    } else {
        const std::vector<std::pair<std::string, Thresholds>> neighbourhoods{{"2 px → 1 px", {.neighbourhood = 1}},
                                                                             {"2 px → 4 px", {.neighbourhood = 4}}};
        ask(
            questions, "penumbra_rmse_dilated",
            [](const Thresholds& near, const ScoredFrame& f) { return metrics::penumbraErrorsBy(near, f).dilated; },
            neighbourhoods);
        ask(questions, "umbra_leak", metrics::umbraLeakBy, neighbourhoods);
    }
    return questions;
}

/// Rows with their values before and after the change.
struct Ranking {
    std::string metric, change;
    struct Row {
        std::string variant;
        double before, after;
    };
    std::vector<Row> rows = {};

    void add(const std::string& variant, std::optional<double> before, std::optional<double> after) {
        if (before && after) rows.push_back({variant, *before, *after});
    }
};

struct Moved {
    std::string variant;
    std::size_t from, to;
    [[nodiscard]] std::size_t far() const { return from < to ? to - from : from - to; }
};

/// A row's place is 1 and one for each that errs less.
std::size_t placeOf(const Ranking& ranking, double Ranking::Row::*value, double own) {
    return 1 + static_cast<std::size_t>(
                   std::ranges::count_if(ranking.rows, [&](const Ranking::Row& row) { return row.*value < own; }));
}

std::vector<Moved> movedRows(const Ranking& ranking) {
    std::vector<Moved> moved;
    for (const Ranking::Row& row : ranking.rows) {
        const Moved here{row.variant, placeOf(ranking, &Ranking::Row::before, row.before),
                         placeOf(ranking, &Ranking::Row::after, row.after)};
        if (here.far() > 0) moved.push_back(here);
    }
    std::ranges::stable_sort(moved, std::ranges::greater(), &Moved::far);
    return moved;
}

/// Of the pairs of rows, those of which now the other is the better one.
double reversedShare(const Ranking& ranking) {
    double reversed = 0, pairs = 0;
    for (std::size_t i = 0; i < ranking.rows.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Ranking::Row &a = ranking.rows[i], &b = ranking.rows[j];
            ++pairs;
            reversed += (a.before - b.before) * (a.after - b.after) < 0 ? 1 : 0;
        }
    return pairs > 0 ? reversed / pairs : 0;
}

void print(const std::string& scene, const Ranking& ranking) {
    if (ranking.rows.empty()) return;
    constexpr std::size_t named = 4;
    const std::vector<Moved> moved = movedRows(ranking);
    std::vector<std::string> farthest;
    for (const Moved& row : moved | std::views::take(named))
        farthest.push_back(fmt::format("`{}` {} → {}", row.variant, row.from, row.to));
    fmt::print("| {} | `{}` | {} | {} | {} | {:.1f} % | {} |\n", scene, ranking.metric, ranking.change, ranking.rows.size(),
               moved.size(), 100 * reversedShare(ranking), fmt::join(farthest, ", "));
    std::fflush(stdout);
}

class Rankings {
public:
    Rankings(const std::string& id, const groundtruth::Cache& cache)
        : scene_(loadScene(id, Profile::Gate)), graded_(gradedTruth(scene_)), here_(scene_, cache),
          double_(twiceTheSize(scene_), cache), standard_(still(loadScene(id, Profile::Standard)), cache),
          questions_(questionsOf(graded_)) {
        for (Scene& view : otherViews(scene_, views))
            views_.push_back(std::make_unique<ChangedScene>(std::move(view), cache));
        for (const Question& question : questions_) byThreshold_.push_back({question.metric, question.change});
    }

    void add(const techniques::Variant& variant) {
        if (variant.isLod() || notApplicable(scene_, variant)) return;
        SceneFrames& frames = here_.frames();
        const auto own = scoredError(frames, variant, firstSeed, graded_);
        const Image<float> v = frames.stage().visibility();
        for (std::size_t i = 0; i < questions_.size(); ++i) {
            const ScoredFrame frame{v, frames.truth(graded_), frames.mask(graded_)};
            byThreshold_[i].add(variant.name, questions_[i].published(frame), questions_[i].changed(frame));
        }
        bySize_.add(variant.name, own, scoredError(double_.frames(), variant, firstSeed, graded_));
        byProfile_.add(variant.name, own, scoredError(standard_.frames(), variant, firstSeed, graded_));
        bySeed_.add(variant.name, own, overSeeds(variant, own, v));
        if (!variant.entry->temporal) byView_.add(variant.name, own, overViews(variant, own));
    }

    void print() const {
        for (const Ranking& ranking : byThreshold_) shadowbench::print(scene_.id, ranking);
        for (const Ranking* ranking : {&bySize_, &byProfile_, &bySeed_, &byView_}) shadowbench::print(scene_.id, *ranking);
    }

private:
    static Scene still(Scene scene) {
        scene.timeline.moving = 0;
        return scene;
    }

    static Scene twiceTheSize(Scene scene) {
        scene.size *= 2;
        return still(std::move(scene));
    }

    std::optional<double> overSeeds(const techniques::Variant& variant, std::optional<double> own, const Image<float>& v) {
        std::vector<double> errors;
        if (own) errors.push_back(*own);
        for (std::uint32_t seed = firstSeed + 1; seed < firstSeed + seeds; ++seed) {
            const auto error = scoredError(here_.frames(), variant, seed, graded_);
            if (std::ranges::equal(here_.frames().stage().visibility(), v)) return own; // it draws the same with all
            if (error) errors.push_back(*error);
        }
        return errors.empty() ? std::nullopt : std::optional(metrics::meanInterval(errors).mean);
    }

    std::optional<double> overViews(const techniques::Variant& variant, std::optional<double> own) {
        std::vector<double> errors;
        if (own) errors.push_back(*own);
        for (const auto& view : views_)
            if (const auto error = scoredError(view->frames(), variant, firstSeed, graded_)) errors.push_back(*error);
        return errors.empty() ? std::nullopt : std::optional(metrics::meanInterval(errors).mean);
    }

    Scene scene_;
    Truth graded_;
    ChangedScene here_, double_, standard_;
    std::vector<std::unique_ptr<ChangedScene>> views_ = {};
    std::vector<Question> questions_;
    std::vector<Ranking> byThreshold_ = {};
    std::string error_ = graded_ == Truth::Hard ? "mismatch" : "rmse"; // errorBy(graded_, …)
    Ranking bySize_{error_, "256² → 512²"}, byProfile_{error_, "gate → standard profile"}, bySeed_{error_, "one seed → 8"},
        byView_{error_, "one view → 5"};
};

struct Options {
    std::vector<std::string> scenes, techniques{"*"};
};

void run(const Options& options) {
    const auto context = gl::Context::create();
    const groundtruth::Cache cache(groundtruth::defaultCacheFolder());
    fmt::print("| scene | ranked by | changed | rows | change place | pairs reversed | farthest |\n"
               "|---|---|---|---|---|---|---|\n");
    for (const std::string& id : options.scenes.empty() ? standardScenes() : options.scenes) {
        Rankings rankings(id, cache);
        for (const std::string& pattern : options.techniques)
            for (const techniques::Variant& variant : techniques::matchVariants(pattern)) rankings.add(variant);
        rankings.print();
    }
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    shadowbench::Options options;
    CLI::App app("What the places of rows owe to thresholds, image size, seeds and views");
    app.add_option("--scene", options.scenes, "Scene ids or files (default: the standard scenes)");
    app.add_option("--technique", options.techniques, "Variants, or globs over ids (default: all)");
    CLI11_PARSE(app, argc, argv);
    try {
        shadowbench::run(options);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
