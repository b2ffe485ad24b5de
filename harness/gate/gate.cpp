#include "harness/gate/gate.h"

#include "base/progress_line.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/environment.h"
#include "harness/gate/baseline.h"
#include "harness/gate/bounds.h"
#include "harness/gate/failure_pictures.h"
#include "harness/gate/judged_cells.h"
#include "harness/gate/verdict.h"
#include "harness/measure/callgrind.h"
#include "scene/load/load.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <set>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path ownProgram() { return fs::read_symlink("/proc/self/exe"); }

/// Shows a stage of the gate as one line of progress.
class StageLine {
public:
    StageLine(const std::string& what, bool quiet) : line_("gate: " + what, 100, quiet) {}
    [[nodiscard]] Progress progress() {
        return [this](double share, std::string_view what) { line_.show(static_cast<int>(100 * share), 0.0, what); };
    }

private:
    ProgressLine line_;
};

class Gate {
public:
    explicit Gate(const GateOptions& options)
        : options_(options), cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache),
          cells_(options) {
        if (options.instructions) timing::valgrindVersion(); // to fail before the long part
    }

    GateResult judge() {
        const Baseline base = findOrBuildBase();
        const MeasuredProgram head(ownProgram(), cache_);
        const Commit commit = builtFrom();
        result_.base = base.name;
        noteUnknownScenes();
        result_.head = commit.hash.substr(0, 12) + (commit.dirty ? " with changes" : "");
        if (base.kind == Baseline::Kind::Records)
            judgeAgainstRecords(base, head);
        else
            judgeAgainstProgram(MeasuredProgram(base.file, cache_), head);
        return std::move(result_);
    }

private:
    Baseline findOrBuildBase() {
        StageLine line("base", options_.quiet);
        return timed("building the base", [&] { return findBaseline(options_.base, cache_, line.progress()); });
    }

    void judgeAgainstRecords(const Baseline& base, const MeasuredProgram& head) {
        std::vector<Record> before = readRecords(base.file);
        std::erase_if(before, [&](const Record& r) { return !isJudged(r); });
        const bool counted =
            std::ranges::any_of(before, [](const Record& r) { return r.values["cost.instructions"].has_value(); });
        if (options_.time) result_.notes.emplace_back("time is not judged: the base is a file of records, not a program");
        if (options_.instructions && !counted)
            result_.notes.emplace_back("instructions are not judged: the base's records hold none");
        const bool instructions = options_.instructions && counted;
        judgeRecords(before, measure(head, "head", instructions), cells_.steps(head, instructions));
        addPictures(nullptr, head);
    }

    void judgeAgainstProgram(const MeasuredProgram& base, const MeasuredProgram& head) {
        noteWhatIsGone(base, head);
        const std::vector<Record> before = measure(base, "base", options_.instructions);
        judgeRecords(before, measure(head, "head", options_.instructions), cells_.steps(head, options_.instructions));
        if (options_.time) judgeTimes(base, head);
        addPictures(&base, head);
    }

    std::vector<Record> measure(const MeasuredProgram& program, const char* who, bool instructions) {
        StageLine line(who, options_.quiet);
        Measured measured = program.measure(cells_.steps(program, instructions), line.progress());
        for (const StepTime& step : measured.times)
            result_.times.push_back({fmt::format("{}: {}", who, step.name), step.seconds});
        return std::move(measured.records);
    }

    void judgeRecords(const std::vector<Record>& before, const std::vector<Record>& now, const std::vector<Step>& steps) {
        result_.changes = compare(before, now);
        std::vector<Bound> bounds = cells_.watchlist.bounds;
        if (options_.profile == Profile::Gate) // what scenes expect, they expect of this profile
            for (const JudgedScene& scene : cells_.scenes)
                for (Bound& bound : boundsOf(loadScene(scene.argument, options_.profile)))
                    bounds.push_back(std::move(bound));
        for (Change& change : judgeBounds(now, bounds)) result_.changes.push_back(std::move(change));
        requireEveryCell(before, now, steps);
    }

    /// Every cell that was to be measured has a record that can be judged, and the base holds some of them.
    void requireEveryCell(const std::vector<Record>& before, const std::vector<Record>& now,
                          const std::vector<Step>& steps) {
        for (const Record& record : now)
            if (record.status == Status::Error)
                result_.unjudged.push_back(fmt::format("{} on {}: {}", record.variant, record.scene, record.reason));
        std::set<std::pair<std::string, std::string>> there;
        for (const Record& record : now)
            if (!record.sweep) there.emplace(record.scene, record.variant);
        for (const JudgedScene& scene : cells_.scenes)
            for (const std::string& variant : scene.variants)
                if (!there.contains({scene.id, variant}))
                    result_.unjudged.push_back(fmt::format("{} on {} was not measured", variant, scene.id));
        if (std::ranges::any_of(steps, [](const Step& s) { return s.records == "sweep.jsonl"; }) &&
            std::ranges::none_of(before, [](const Record& r) { return r.sweep.has_value(); }))
            result_.notes.emplace_back("break points are not judged: the base's records hold no sweep");
        std::set<CellKey> known;
        for (const Record& record : before) known.insert(cellOf(record));
        if (std::ranges::none_of(now, [&](const Record& r) { return known.contains(cellOf(r)); }))
            result_.unjudged.emplace_back("the base holds none of the cells: nothing is compared");
    }

    void noteUnknownScenes() {
        std::vector<std::string> known;
        for (const JudgedScene& scene : cells_.scenes) known.push_back(scene.id);
        for (const std::string& scene : cells_.watchlist.unknownScenes(known))
            result_.notes.push_back(
                fmt::format("{} names a scene \"{}\" that is not among the chosen ones", options_.bounds.string(), scene));
    }

    void noteWhatIsGone(const MeasuredProgram& base, const MeasuredProgram& head) {
        if (!options_.techniques.empty()) return;
        for (const std::string& id : base.techniques())
            if (!head.knowsVariant(id))
                result_.unjudged.push_back(fmt::format("{} no longer exists, so it is not judged", id));
    }

    void judgeTimes(const MeasuredProgram& base, const MeasuredProgram& head) {
        const std::vector<TimedCell> cells = cells_.timedCells(base, head);
        if (cells.empty()) {
            result_.notes.emplace_back("time is not judged: none of the chosen cells is timed");
            return;
        }
        StageLine line("time", options_.quiet);
        PairedOptions paired;
        paired.profile = options_.profile;
        const std::vector<TimeJudgement> judgements = timed(
            "time in pairs", [&] { return judgePairedTime(base.file(), head.file(), cells, paired, line.progress()); });
        for (const TimeJudgement& judgement : judgements) addTime(judgement, paired.rule);
    }

    void addTime(const TimeJudgement& judgement, const TimeRule& rule) {
        const std::string scene = sceneId(judgement.cell.scene), variant = judgement.cell.variant;
        const std::string figures =
            fmt::format("{} on {}: a frame takes {:.3f} of the base's CPU time", variant, scene, judgement.ratio);
        if (judgement.controlAlarm) {
            result_.unjudged.push_back(fmt::format("{}, but the base against itself differs, too: the machine is not steady "
                                                   "enough",
                                                   figures));
            return;
        }
        const bool slower = judgement.verdict == TimeVerdict::Slower;
        if (judgement.verdict == TimeVerdict::Unclear)
            result_.notes.push_back(fmt::format("{}, which {} rounds leave uncertain", figures, judgement.rounds));
        result_.changes.push_back({scene, variant, "time.ratio", Class::Time, 1, judgement.ratio, rule.floor,
                                   slower ? Direction::Worse : Direction::Same,
                                   fmt::format("{}, surely more than {:.3f}", figures, judgement.lowerBound)});
    }

    void addPictures(const MeasuredProgram* base, const MeasuredProgram& head) {
        StageLine line("pictures of what is worse", options_.quiet);
        result_.pictures = timed("pictures of what is worse", [&] {
            return drawFailures(result_.changes, cells_, base, head, options_.out, line.progress());
        });
    }

    template <class Work>
    std::invoke_result_t<Work> timed(const std::string& what, Work work) {
        const auto start = Clock::now();
        auto outcome = work();
        result_.times.push_back({what, std::chrono::duration<double>(Clock::now() - start).count()});
        return outcome;
    }

    [[nodiscard]] bool isJudged(const Record& r) const {
        if (r.profile != name(options_.profile) || r.seed != options_.seed) return false;
        return cells_.chooses(r.scene, r.sweep ? r.sweep->curve : r.variant);
    }

    [[nodiscard]] std::string sceneId(const std::string& argument) const {
        return std::ranges::find(cells_.scenes, argument, &JudgedScene::argument)->id;
    }

    const GateOptions& options_;
    fs::path cache_;
    JudgedCells cells_;
    GateResult result_;
};

} // namespace

ExitCode GateResult::code() const {
    const ExitCode verdict = verdictOf(changes);
    if (verdict == ExitCode::Pass && !unjudged.empty()) return ExitCode::Inconclusive;
    return verdict;
}

GateResult gate(const GateOptions& options) {
    const auto start = Clock::now();
    GateResult result = Gate(options).judge();
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

} // namespace shadowbench::gate
