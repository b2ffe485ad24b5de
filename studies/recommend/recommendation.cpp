#include "studies/recommend/recommendation.h"

#include "base/folder_lock.h"
#include "base/progress_line.h"
#include "base/words.h"
#include "base/worker_processes.h"
#include "groundtruth/store/cache.h"
#include "harness/metrics/table.h"
#include "harness/records/comparability.h"
#include "harness/render/shared_shaders.h"
#include "harness/runs/run.h"
#include "report/advice.h"
#include "report/costing.h"
#include "scene/load/load.h"
#include "studies/gpu_cost/gpu_cost.h"
#include "techniques/catalog.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>

namespace shadowbench::recommend {
namespace {

constexpr Words<Question, 4> questions{"question",
                                       {{{Question::Casters, "casters"},
                                         {Question::Technique, "technique"},
                                         {Question::Map, "map"},
                                         {Question::Samples, "samples"}}}};

bool hasLevels(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [](const Object& object) { return object.levels.size() > 1; });
}

std::set<Question> questionsOn(const Scene& scene, const RecommendOptions& options) {
    if (!options.questions.empty()) return options.questions;
    if (hasLevels(scene)) return {Question::Casters};
    return {Question::Technique, Question::Map};
}

/// Of the standard scenes those with levels, unless the question is another one.
std::vector<std::string> chosenScenes(const RecommendOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> ids = standardScenes();
    if (options.questions.empty() || options.questions.contains(Question::Casters))
        std::erase_if(ids, [&](const std::string& id) {
            return !hasLevels(loadScene(id, options.profile, metrics::boundedMetrics()));
        });
    return ids;
}

CasterRecommendation casterLevels(const Scene& scene, const RecommendOptions& options) {
    ProgressLine line(scene.id + " casters", 1, options.quiet);
    CasterRecommendation casters =
        recommendCasters(scene, options.casters, [&](double share, std::string_view what) { line.show(0, share, what); });
    line.show(1, 0, "");
    return casters;
}

/// The variants whose records answer the question.
std::vector<std::string> variantsFor(Question question, const std::vector<std::string>& patterns) {
    if (question == Question::Map) return variantsOver(Resource::MapTexels, patterns);
    if (question == Question::Samples) return variantsOver(Resource::Samples, patterns);
    return patterns;
}

/// Records that answer the question on the scene, with the tolerance that was asked for.
class Records {
public:
    explicit Records(const RecommendOptions& options) : options_(options) {
        if (!options.records.empty()) given_ = gate::readOfOneDevice({options.records});
    }

    std::vector<Record> of(Question question, const std::vector<std::string>& techniques, const std::string& sceneIdOrFile,
                           const Scene& scene) {
        std::vector<Record> records = given_ ? *given_ : computed(question, techniques, sceneIdOrFile);
        if (options_.standing) records = report::standing(std::move(records));
        if (report::ofScene(records, scene.id).empty())
            throw BadInput(fmt::format("{} holds no record of scene {}", options_.records.string(), scene.id));
        if (options_.casters.tolerance.empty()) return records;
        const Errors tolerances = parseTolerance(options_.casters.tolerance, scene.light);
        for (Record& record : records) record.tolerances = tolerances;
        return records;
    }

    [[nodiscard]] ExitCode code() const { return code_; }

private:
    std::vector<Record> computed(Question question, const std::vector<std::string>& techniques,
                                 const std::string& sceneIdOrFile) {
        RunOptions cells;
        cells.scenes = {sceneIdOrFile};
        cells.techniques = variantsFor(question, techniques);
        cells.profile = options_.profile;
        cells.out = options_.out / std::string(name(question));
        cells.cache = options_.cache;
        cells.measure.time = question == Question::Technique;
        cells.measure.otherScreen = cells.measure.time && !options_.card.empty();
        cells.resume = true;
        cells.quiet = options_.quiet;
        const OutputLock alone(cells.out);
        if (cells.measure.timed()) checkInOwnProcess([&] { (void)run(cells); }); // times make a context, and more runs fork
        RunResult result = run(cells);                                           // of cells that are kept
        if (code_ == ExitCode::Pass) code_ = result.code;
        return std::move(result.records);
    }

    const RecommendOptions& options_;
    std::optional<std::vector<Record>> given_;
    ExitCode code_ = ExitCode::Pass;
};

std::set<techniques::Need> needsOf(const RecommendOptions& options) {
    std::set<techniques::Need> needs = options.needs;
    if (options.standing)
        for (const techniques::Need moving : {techniques::Need::MovingLight, techniques::Need::MovingCasters})
            needs.erase(moving);
    return needs;
}

/// Adds what frames cost on the card; returns a sentence for each technique whose cost is not known there.
std::vector<std::string> model(std::vector<Record>& records, const RecommendOptions& options) {
    gpucost::GpuCostOptions study;
    study.cards = {options.card};
    study.cache = options.cache;
    study.quiet = options.quiet;
    gpucost::GpuCostResult costs = gpucost::gpuCosts(records, study);
    gpucost::addTo(records, costs.frames);
    std::ranges::move(costs.leftOut, std::back_inserter(costs.errors));
    return std::move(costs.errors);
}

void adviseTechnique(const std::vector<Record>& records, const std::set<techniques::Need>& needs, Recommendation& result) {
    const report::Advice advice = report::adviceFor(records, result.scene, needs);
    for (std::string& note : report::notesOn(advice, records, needs)) result.techniqueNotes.push_back(std::move(note));
    if (!advice.take) return;
    const Record& record = records[*advice.take];
    const std::optional<double> error = metrics::bounded(record.values, result.tolerances.front().metric);
    const report::Costing costing = report::shownCosting(records, result.scene);
    result.technique =
        Cheapest{record.variant, error.value_or(0), costing.of(record)->ratio, report::knowsMotion(record), costing.card};
}

/// The row whose error is explained: the one that is advised, else the one that errs least.
std::optional<std::string> rowToExplain(const std::vector<Record>& records, const Recommendation& result) {
    if (result.technique) return result.technique->variant;
    std::optional<std::string> row;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : report::scoredOf(records, result.scene)) {
        const auto error = metrics::bounded(records[i].values, result.tolerances.front().metric);
        if (report::isBaseline(records[i]) || !error || *error >= least) continue;
        least = *error;
        row = records[i].variant;
    }
    return row;
}

/// Draws the rows that were found on the scenes, again and without one cause of their errors after the other.
class LeftErrors {
public:
    explicit LeftErrors(const RecommendOptions& options) : options_(options) {}

    void add(Scene scene, std::size_t recommendation, std::optional<std::string> row) {
        if (row) rows_.push_back({std::move(scene), recommendation, std::move(*row)});
    }

    void explain(std::vector<Recommendation>& all) const {
        if (rows_.empty()) return;
        const groundtruth::Cache cache(options_.cache.empty() ? groundtruth::defaultCacheFolder() : options_.cache);
        const auto context = contextOfRun(cache.folder(), false);
        for (const Row& row : rows_) {
            Truths truths(row.scene, cache);
            SceneFrames frames(row.scene, truths);
            auto& left = all[row.recommendation].left;
            left = causes::explain(frames, techniques::parseVariant(row.variant), 1);
            left->releasePixels();
        }
    }

private:
    struct Row {
        Scene scene;
        std::size_t recommendation;
        std::string variant;
    };
    const RecommendOptions& options_;
    std::vector<Row> rows_;
};

void answerFromRecords(Question question, const std::vector<Record>& records, const std::set<techniques::Need>& needs,
                       Recommendation& result) {
    result.tolerances = report::tolerances(records, result.scene);
    if (result.tolerances.empty())
        throw Inconclusive(fmt::format("no record of scene {} is scored, so that nothing can be advised", result.scene));
    if (question == Question::Technique) adviseTechnique(records, needs, result);
    if (question == Question::Map) result.maps = leastAdequate(records, result.scene, Resource::MapTexels);
    if (question == Question::Samples) result.samples = leastAdequate(records, result.scene, Resource::Samples);
}

} // namespace

std::string_view name(Question question) { return questions.of(question); }
Question questionNamed(std::string_view word) { return questions.named(word); }

namespace {

/// Whose smallest map is named where the user did not ask for it: that of the technique that is advised, if it has one.
std::optional<std::vector<std::string>> advisedWithMap(const Recommendation& result) {
    if (!result.technique) return {};
    const std::string& advised = result.technique->variant;
    const auto all = techniques::catalog(); // records may be of another catalogue
    const auto entry = std::ranges::find(all, techniques::idOfVariant(advised), &techniques::Entry::id);
    if (entry == all.end() ||
        std::ranges::find(entry->parameters, "map", &techniques::Parameter::name) == entry->parameters.end())
        return {};
    return {{advised}};
}

} // namespace

Recommendations recommend(const RecommendOptions& options) {
    if (!options.card.empty()) (void)gpu::cardNamed(options.card);
    Recommendations all;
    Records records(options);
    const std::set<techniques::Need> needs = needsOf(options);
    std::vector<Record> ofTechniques; // on all scenes
    std::vector<std::string> scenes;
    LeftErrors left(options);
    for (const std::string& idOrFile : chosenScenes(options)) {
        const Scene scene = loadScene(idOrFile, options.profile, metrics::boundedMetrics());
        scenes.push_back(scene.id);
        Recommendation result{scene.id, questionsOn(scene, options), {}, {}, {}, {}, {}, {}, {}};
        for (const Question question : questionsOn(scene, options)) {
            if (question == Question::Casters) {
                result.casters = casterLevels(scene, options);
                continue;
            }
            std::optional<std::vector<std::string>> techniques = options.techniques;
            if (question == Question::Map && options.questions.empty()) techniques = advisedWithMap(result);
            if (!techniques) {
                result.questions.erase(question);
                continue;
            }
            std::vector<Record> found = records.of(question, *techniques, idOrFile, scene);
            if (question == Question::Technique && !options.card.empty()) result.techniqueNotes = model(found, options);
            answerFromRecords(question, found, needs, result);
            if (question != Question::Technique) continue;
            for (const std::size_t i : report::ofScene(found, scene.id)) ofTechniques.push_back(found[i]);
            if (options.records.empty()) left.add(scene, all.scenes.size(), rowToExplain(found, result));
        }
        if (result.casters && !result.casters->verified) all.code = ExitCode::Inconclusive;
        all.scenes.push_back(std::move(result));
    }
    left.explain(all.scenes); // at last: runs fork, which no context outlives
    if (scenes.size() > 1 && !ofTechniques.empty()) all.common = report::commonAdvice(ofTechniques, scenes, needs);
    if (all.code == ExitCode::Pass) all.code = records.code();
    return all;
}

} // namespace shadowbench::recommend
