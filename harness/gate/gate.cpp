#include "harness/gate/gate.h"

#include "base/progress_line.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/environment.h"
#include "harness/gate/anchor.h"
#include "harness/gate/baseline.h"
#include "harness/gate/bounds.h"
#include "harness/gate/failure_pictures.h"
#include "harness/gate/judged_cells.h"
#include "harness/gate/truth_sample.h"
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
        const MeasuredProgram head(fs::is_symlink(options_.head) ? fs::read_symlink(options_.head) : options_.head, cache_);
        const Commit commit = builtFrom();
        result_.base = base.name;
        result_.head = commit.hash.substr(0, 12) + (commit.dirty ? " with changes" : "");
        if (base.kind == Baseline::Kind::Records)
            judgeAgainstRecords(base, head);
        else if (options_.external != nullptr)
            throw BadInput(fmt::format("--external needs records as --base, made by `run --external`: {} is a program, for "
                                       "which the same renderers would be called again",
                                       base.name));
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
        noteUnknownScenes();
        std::vector<Record> before = readRecords(base.file);
        std::erase_if(before, [&](const Record& r) { return !isJudged(r); });
        const bool counted =
            std::ranges::any_of(before, [](const Record& r) { return r.values["cost.instructions"].has_value(); });
        result_.notes.emplace_back("the base is a file of records: this build's policy alone judges");
        if (options_.time) result_.notes.emplace_back("time is not judged: the base is a file of records, not a program");
        if (options_.instructions && !counted)
            result_.notes.emplace_back("instructions are not judged: the base's records hold none");
        const bool instructions = options_.instructions && counted;
        std::vector<Record> now = measure(head, "head", instructions);
        std::ranges::move(measureSteps(head, "head", cells_.externalSteps()), std::back_inserter(now));
        judgeRecords(before, now, cells_.steps(head, instructions));
        if (const auto why = whyMeaningless(before, now, options_.aa)) result_.unjudged.push_back(*why);
        judgeAgainstAnchors(now);
        addPictures(nullptr, head);
    }

    void judgeAgainstProgram(const MeasuredProgram& base, const MeasuredProgram& head) {
        if (isDecidedAlready(base, head)) return;
        unitePolicies(base);
        noteUnknownScenes();
        const std::vector<Record> before = measure(base, "base", options_.instructions);
        const std::vector<Record> now = measure(head, "head", options_.instructions);
        judgeRecords(before, now, cells_.steps(head, options_.instructions));
        if (const auto why = whyMeaningless(before, now, true)) result_.unjudged.push_back(*why);
        judgeAgainstAnchors(now);
        if (options_.time) judgeTimes(base, head);
        addPictures(&base, head);
    }

    /// One program is never worse than itself: of one commit that is a mistake, of two it is all there is to say.
    bool isDecidedAlready(const MeasuredProgram& base, const MeasuredProgram& head) {
        if (options_.aa) return false;
        const auto &before = base.identity(), &now = head.identity();
        const bool same = base.content() == head.content() || (before && now && before->program == now->program);
        if (!same) return false;
        if (!before || !now || (before->commit == now->commit && before->dirty == now->dirty))
            throw Inconclusive(
                fmt::format("base and head are one program ({}), so nothing would be judged; name another base, "
                            "or say --aa if that is meant",
                            result_.head));
        const Policy judged = readPolicy(options_.bounds, Profile::Gate);
        if (!sentencesOf(loosened(before->policy, judged)).empty() || !sentencesOf(loosened(judged, before->policy)).empty())
            return false;
        result_.notes.push_back(
            fmt::format("commits {} and {} make the same program with the same policy: nothing was measured",
                        before->commit.substr(0, 12), now->commit.substr(0, 12)));
        return true;
    }

    void unitePolicies(const MeasuredProgram& base) {
        std::optional<Policy> policy;
        if (base.identity())
            policy = base.identity()->policy;
        else
            result_.notes.emplace_back("the base was built before programs said what they judge: this build's policy alone "
                                       "judges");
        cells_ = JudgedCells(options_, policy, base.variants());
        std::ranges::copy(cells_.loosened, std::back_inserter(result_.notes));
        std::ranges::copy(cells_.gone, std::back_inserter(result_.unjudged));
    }

    std::vector<Record> measure(const MeasuredProgram& program, const char* who, bool instructions) {
        return measureSteps(program, who, cells_.steps(program, instructions));
    }

    std::vector<Record> measureSteps(const MeasuredProgram& program, const char* who, const std::vector<Step>& steps) {
        StageLine line(who, options_.quiet);
        Measured measured = program.measure(steps, line.progress());
        for (const StepTime& step : measured.times)
            result_.times.push_back({fmt::format("{}: {}", who, step.name), step.seconds});
        return std::move(measured.records);
    }

    void judgeRecords(const std::vector<Record>& before, const std::vector<Record>& now, const std::vector<Step>& steps) {
        result_.changes = compare(before, now);
        std::vector<Bound> bounds = cells_.watchlist.bounds;
        if (options_.profile == Profile::Gate) // what scenes expect, they expect of this profile; those of others are known
            for (const JudgedScene& scene : cells_.scenes)
                if (!scene.content.empty())
                    std::ranges::move(boundsOf(loadScene(scene.argument, options_.profile)), std::back_inserter(bounds));
        std::vector<Record> ofSeed = now;
        std::erase_if(ofSeed, [&](const Record& r) { return r.seed != options_.seed; });
        for (Change& change : judgeBounds(ofSeed, bounds)) result_.changes.push_back(std::move(change));
        requireEveryCell(before, now, steps);
        std::ranges::move(contradictedTruths(cells_.scenes, options_.profile, cache_, builtFrom().hash, options_.quiet),
                          std::back_inserter(result_.unjudged));
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
    }

    /// The drift since each anchor, in units of what one commit may change.
    void judgeAgainstAnchors(const std::vector<Record>& now) {
        if (std::ranges::all_of(now, isExternal)) return; // of which an anchor knows nothing
        for (const Anchor& anchor : cells_.watchlist.anchors) {
            StageLine line("anchor", options_.quiet);
            const Baseline found =
                timed("building the anchor", [&] { return findBaseline(anchor.commit, cache_, line.progress()); });
            const std::vector<Record> before =
                found.kind == Baseline::Kind::Records
                    ? readRecords(found.file)
                    : measure(MeasuredProgram(found.file, cache_), "anchor", options_.instructions);
            AnchorJudgement judgement = judgeDrift(anchor, before, now);
            std::ranges::move(judgement.changes, std::back_inserter(result_.changes));
            std::ranges::move(judgement.notes, std::back_inserter(result_.notes));
            if (judgement.compared == 0)
                result_.unjudged.push_back(
                    fmt::format("nothing can be compared with the anchor {}: name a younger commit in {}", anchor.commit,
                                options_.bounds.string()));
        }
    }

    void noteUnknownScenes() {
        std::vector<std::string> known;
        for (const JudgedScene& scene : cells_.scenes) known.push_back(scene.id);
        for (const std::string& scene : cells_.watchlist.unknownScenes(known))
            result_.notes.push_back(
                fmt::format("{} names a scene \"{}\" that is not among the chosen ones", options_.bounds.string(), scene));
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
        Change change{scene,
                      variant,
                      "time.ratio",
                      Class::Time,
                      1,
                      judgement.ratio,
                      rule.floor,
                      Direction::Same,
                      fmt::format("{}, surely more than {:.3f}", figures, judgement.lowerBound)};
        if (judgement.controlAlarm) {
            change.direction = Direction::Unjudged;
            change.sentence =
                fmt::format("{}, but the base against itself differs, too: the machine is not steady enough", figures);
        } else if (judgement.verdict == TimeVerdict::Slower) {
            change.direction = Direction::Worse;
        } else if (judgement.verdict == TimeVerdict::Unclear) {
            change.direction = Direction::Unclear;
            change.sentence = fmt::format("{}, which {} rounds leave uncertain", figures, judgement.rounds);
        }
        result_.changes.push_back(std::move(change));
        if (!judgement.waits) return;
        result_.changes.push_back(
            {scene, variant, "time.wall_ratio", Class::Time, 1, judgement.wallRatio, rule.wallFloor, Direction::Worse,
             fmt::format("{} on {}: a frame takes {:.3f} of the base's wall time and {:.3f} of its CPU "
                         "time: it waits",
                         variant, scene, judgement.wallRatio, judgement.ratio)});
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

    /// Of a base's records: what this build measures, and what it no longer has of a scene that it judges with all
    /// techniques.
    [[nodiscard]] bool isJudged(const Record& r) const {
        if (r.profile != name(options_.profile) || r.seed != options_.seed) return false;
        if (cells_.chooses(r.scene, r.sweep ? r.sweep->curve : r.variant)) return true;
        const std::vector<std::string> standard = standardScenes();
        return options_.techniques.empty() && options_.scenes.empty() && !r.sweep &&
               std::ranges::find(standard, r.scene) != standard.end();
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
