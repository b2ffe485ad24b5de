#include "gate/gate.h"

#include "base/progress_line.h"
#include "gate/baseline.h"
#include "gate/bounds.h"
#include "gate/failure_logs.h"
#include "gate/failure_pictures.h"
#include "gate/judged_cells.h"
#include "gate/judged_shaders.h"
#include "gate/known_cells.h"
#include "gate/truth_sample.h"
#include "gate/verdict.h"
#include "gate/waivers.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/environment.h"
#include "harness/measure/callgrind.h"
#include "scene/load/load.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <utility>

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
        for (const fs::path& earlier : {options_.out / "logs", otherFolder(), pictureFolder(options_.out)})
            fs::remove_all(earlier);
        const MeasuredProgram head(fs::is_symlink(options_.head) ? fs::read_symlink(options_.head) : options_.head, cache_);
        const Baseline base = findOrBuildBase(head);
        const Commit commit = builtFrom();
        result_.base = base.name;
        result_.head = commit.hash.substr(0, 12) + (commit.dirty ? " with changes" : "");
        if (base.kind == Baseline::Kind::Records)
            judgeAgainstRecords(base, head);
        else if (options_.external != nullptr)
            throw BadInput(fmt::format("--external needs records as --base, made by `run --external`: {} is a program, for "
                                       "which the same renderers would be called again",
                                       base.name));
        else if (base.kind == Baseline::Kind::HeadsProgram) {
            if (base.commit == commit.hash && !commit.dirty) refuseOneProgram();
            noteOneProgram(base.commit, commit.hash);
        } else
            judgeAgainstProgram(MeasuredProgram(base.file, cache_), head);
        return std::move(result_);
    }

private:
    Baseline findOrBuildBase(const MeasuredProgram& head) {
        StageLine line("base", options_.quiet);
        const bool isBuilt = options_.sameProgram || !head.build() || !isJudgedBy(head.build()->policy);
        return timed("building the base", [&] {
            return findBaseline(options_.base, cache_, isBuilt ? "" : head.build()->program, line.progress());
        });
    }

    [[nodiscard]] bool isJudgedBy(const Policy& policy) const {
        const Policy judged = readPolicy(options_.bounds, Profile::Gate);
        return loosened(policy, judged).empty() && loosened(judged, policy).empty();
    }

    void judgeAgainstRecords(const Baseline& base, const MeasuredProgram& head) {
        noteUnknownScenes();
        std::vector<Record> before = readRecords(base.file);
        std::erase_if(before, [&](const Record& r) { return !isJudged(r); });
        const bool counted =
            std::ranges::any_of(before, [](const Record& r) { return r.values["cost.instructions"].has_value(); });
        result_.notes.emplace_back("the base is a file of records: this build's policy alone judges");
        if (options_.time) result_.notes.emplace_back("time is not compared: the base is a file of records, not a program");
        if (options_.shader)
            result_.notes.emplace_back("shaders are not compared: the base is a file of records, not a program");
        if (options_.instructions && !counted)
            result_.notes.emplace_back("instructions are not compared: the base's records hold none");
        leaveOutWhatNoRecordIsOf(before);
        std::vector<Record> now = measure(head, "head", options_.instructions && counted, before);
        const std::vector<Record> others = callOthers(head);
        std::ranges::copy(others, std::back_inserter(now));
        judgeRecords(before, now, nullptr);
        if (const auto why = whyMeaningless(before, now, options_.sameProgram)) result_.notCompared.push_back(*why);
        addPictures(nullptr, head);
        std::vector<Change> ofOthers = result_.changes;
        std::erase_if(ofOthers, [](const Change& change) { return !change.variant.starts_with(externalPrefix); });
        std::ranges::move(copyFailures(ofOthers, {before, base.file.parent_path() / "images"},
                                       {others, otherFolder() / "images"}, options_.out),
                          std::back_inserter(result_.pictures));
        fs::remove_all(otherFolder());
    }

    [[nodiscard]] fs::path otherFolder() const { return options_.out / "others"; }

    /// The records of other renderers, which are called once: otherFolder() has their pictures then, and `logs` of the
    /// report what those said that failed.
    std::vector<Record> callOthers(const MeasuredProgram& head) {
        const fs::path folder = otherFolder();
        StageLine line("head, other renderers", options_.quiet);
        std::vector<Record> all;
        for (const Step& step : cells_.externalSteps()) {
            std::ranges::move(timed("head: " + step.name,
                                    [&] {
                                        head.run(step, folder, 1, line.progress());
                                        return readRecords(folder / step.records);
                                    }),
                              std::back_inserter(all));
            if (fs::is_directory(folder / "logs"))
                fs::copy(folder / "logs", options_.out / "logs",
                         fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
        result_.logs = failureLogs(all, options_.out / "logs");
        return all;
    }

    void judgeAgainstProgram(MeasuredProgram base, MeasuredProgram head) {
        if (isDecidedAlready(base, head)) return;
        unitePolicies(base);
        noteUnknownScenes();
        leaveOutWhatIsKnown(base, head);
        if (options_.shader) judgeShadersOf(base, head);
        const std::vector<Record> before = measure(base, "base"), now = measure(head, "head");
        judgeRecords(before, now, &base);
        if (const auto why = whyMeaningless(before, now, true); why && leftOut_ == 0) result_.notCompared.push_back(*why);
        if (options_.time) judgeTimes(base, head);
        addPictures(&base, head);
    }

    void judgeShadersOf(const MeasuredProgram& base, const MeasuredProgram& head) {
        std::vector<std::string> variants; // none: all that shader-cost knows
        if (options_.techniques.empty())
            variants = head.variants();
        else
            for (const techniques::Variant& variant : chosenVariants(options_.techniques, options_.external.get()))
                if (base.knowsVariant(variant.name)) variants.push_back(variant.name);
        const std::size_t all = variants.size(), known = std::erase_if(variants, [&](const std::string&variant) {
                                                     return hasKnownShaders(reachable(base), head.build(), variant);
                                                 });
        noteKnown("shaders", known, all);
        if (variants.empty()) return;
        if (options_.techniques.empty() && known == 0) variants.clear();
        StageLine line("shaders", options_.quiet);
        ShaderJudgement judged =
            timed("shaders", [&] { return judgeShaders(base, head, variants, shaderFolder(options_), line.progress()); });
        std::ranges::move(judged.changes, std::back_inserter(result_.changes));
        std::ranges::move(judged.notCompared, std::back_inserter(result_.notCompared));
        std::ranges::move(judged.notes, std::back_inserter(result_.notes));
    }

    void noteKnown(const char* what, std::size_t known, std::size_t all) {
        if (known > 0)
            result_.notes.push_back(
                fmt::format("{} of {} of {} are the base's: nothing that can decide them has changed", what, known, all));
    }

    /// Of what no change can have reached the head measures a sample, which must equal what the base has or measures; the
    /// rest is judged only where it is kept.
    void leaveOutWhatIsKnown(MeasuredProgram& base, MeasuredProgram& head) {
        const std::vector<Step> steps = cells_.steps(head, options_.instructions);
        const std::vector<Step> sample = sampleOfKnown(reachable(base), head.build(), steps);
        if (sample.empty()) return;
        const Measured before = measureSteps(base, "base, check", sample), now = measureAgain(head, "head, check", sample);
        if (const auto cell = contradicted(sample, before, now)) {
            result_.notCompared.push_back(fmt::format("{} differs from the base, though nothing that can decide it has "
                                                      "changed: everything was measured. Remove {}, "
                                                      "where other results may depend on the same",
                                                      *cell, (cache_ / "gate" / "results").string()));
            base.distrustReach();
            head.distrustReach();
            return;
        }
        std::size_t known = 0, all = 0, checked = 0;
        std::set<std::pair<std::string, std::string>> open; // scene and variant
        for (const Step& step : cells_.steps(base, options_.instructions))
            for (const std::string& technique : step.techniques)
                if (!base.isKept(step, technique)) open.emplace(step.scene, technique);
        for (const Step& step : steps)
            for (const std::string& technique : step.techniques) {
                ++all;
                known += isKnown(reachable(base), head.build(), technique, step.scene);
            }
        for (const Step& step : sample) checked += step.techniques.size();
        if (!options_.all && isJudgedBy(base.build()->policy))
            leftOut_ = cells_.leaveOut([&](const JudgedScene& scene, const std::string& variant) {
                return isKnown(reachable(base), head.build(), variant, scene.id) && open.contains({scene.id, variant});
            });
        noteKnown("results", known, all);
        result_.notes.push_back(fmt::format("{} of these were measured as a check and are equal", checked));
        if (leftOut_ > 0)
            result_.notes.push_back(
                fmt::format("{} cells were measured on neither side, so {} is not written: --all measures them", leftOut_,
                            (options_.out / "results.jsonl").string()));
    }

    /// Of what is judged beside the standard scenes, records as a base may hold nothing: a run makes none of it.
    void leaveOutWhatNoRecordIsOf(const std::vector<Record>& before) {
        std::vector<std::string> left;
        std::erase_if(cells_.scenes, [&](const JudgedScene& scene) {
            const bool out =
                scene.isBeside && std::ranges::none_of(before, [&](const Record& r) { return r.scene == scene.id; });
            if (out) left.push_back(scene.id);
            return out;
        });
        if (std::ranges::none_of(before, [](const Record& r) { return r.sweep.has_value(); }) &&
            !cells_.policy.config.sweeps.empty())
            left.emplace_back("break points");
        if (!left.empty())
            result_.notes.push_back(
                fmt::format("not compared, for the base's records hold nothing of them: {}", fmt::join(left, ", ")));
    }

    /// One program is never worse than itself: of one commit that is a mistake, of two it is all there is to say.
    bool isDecidedAlready(const MeasuredProgram& base, const MeasuredProgram& head) {
        if (options_.sameProgram) return false;
        const auto &before = base.build(), &now = head.build();
        const bool same = base.content() == head.content() || (before && now && before->program == now->program);
        if (!same) return false;
        if (!before || !now || (before->commit == now->commit && before->dirty == now->dirty)) refuseOneProgram();
        if (!isJudgedBy(before->policy)) return false;
        noteOneProgram(before->commit, now->commit);
        return true;
    }

    void noteOneProgram(const std::string& before, const std::string& now) {
        result_.notes.push_back(
            fmt::format("commits {} and {} make the same program with the same policy: nothing was measured",
                        before.substr(0, 12), now.substr(0, 12)));
    }

    [[noreturn]] void refuseOneProgram() const {
        throw Inconclusive(fmt::format("base and head are one program ({}), so nothing would be judged; name another base, "
                                       "or say --same-program if that is meant",
                                       result_.head));
    }

    /// What a head can differ in from the base. Where one program is meant on both sides nothing is taken for known: whether
    /// it measures the same is the question.
    std::optional<BuildInfo> reachable(const MeasuredProgram& base) const {
        return options_.sameProgram ? std::nullopt : base.build();
    }

    void unitePolicies(const MeasuredProgram& base) {
        std::optional<Policy> policy;
        if (base.build())
            policy = base.build()->policy;
        else
            result_.notes.emplace_back("the base was built before programs said what they judge: this build's policy alone "
                                       "judges");
        cells_ = JudgedCells(options_, policy, base.variants());
        result_.loosened = cells_.loosened;
        result_.changes = cells_.gone;
    }

    /// `only`: what these records are of, by scene, seed and whether it is a sweep.
    std::vector<Record> measure(const MeasuredProgram& program, const char* who, bool instructions,
                                const std::vector<Record>& only) {
        std::vector<Step> steps = cells_.steps(program, instructions);
        std::erase_if(steps, [&](const Step& step) {
            return (step.isSweep() || step.seed != options_.seed) && std::ranges::none_of(only, [&](const Record& r) {
                       return r.scene == step.scene && r.seed == step.seed && r.sweep.has_value() == step.isSweep();
                   });
        });
        return measureSteps(program, who, steps).records();
    }

    std::vector<Record> measure(const MeasuredProgram& program, const char* who) {
        return measureSteps(program, who, cells_.steps(program, options_.instructions)).records();
    }

    Measured measureAgain(const MeasuredProgram& program, const char* who, const std::vector<Step>& steps) {
        StageLine line(who, options_.quiet);
        return timed(who, [&] { return program.measureAgain(steps, line.progress()); });
    }

    Measured measureSteps(const MeasuredProgram& program, const char* who, const std::vector<Step>& steps) {
        StageLine line(who, options_.quiet);
        Measured measured = program.measure(steps, line.progress());
        for (const StepTime& step : measured.times)
            result_.times.push_back({fmt::format("{}: {}", who, step.name), step.seconds});
        return measured;
    }

    void judgeRecords(const std::vector<Record>& before, const std::vector<Record>& now, const MeasuredProgram* base) {
        Comparison compared = compare(before, now, cells_.policy.rules, cells_.expected(base));
        result_.presence = std::move(compared.presence);
        std::ranges::move(compared.changes, std::back_inserter(result_.changes));
        std::vector<BoundRule> bounds = cells_.policy.config.bounds;
        if (options_.profile == Profile::Gate) // what scenes expect, they expect of this profile; those of others are known
            for (const JudgedScene& scene : cells_.scenes)
                if (!scene.content.empty())
                    std::ranges::move(boundsOf(loadScene(scene.argument, options_.profile)), std::back_inserter(bounds));
        std::erase_if(bounds, [&](const BoundRule& bound) { // of scenes that this gate does not measure
            return std::ranges::find(cells_.scenes, bound.cells.scene, &JudgedScene::id) == cells_.scenes.end();
        });
        std::ranges::move(judgeBounds(now, bounds, options_.techniques.empty() && leftOut_ == 0),
                          std::back_inserter(result_.changes));
        const fs::path records = options_.out / "results.jsonl"; // the base of a later gate, once this build is accepted
        if (leftOut_ == 0)
            writeRecords(records, now);
        else
            fs::remove(records);
        std::vector<JudgedScene> scored = cells_.scenes;
        std::erase_if(scored, [](const JudgedScene& scene) { return scene.variants.empty(); });
        std::ranges::move(contradictedTruths(scored, options_.profile, cache_, builtFrom().hash, options_.quiet),
                          std::back_inserter(result_.notCompared));
    }

    void noteUnknownScenes() {
        std::vector<std::string> known;
        for (const JudgedScene& scene : cells_.scenes) known.push_back(scene.id);
        for (const std::string& scene : cells_.policy.config.unknownScenes(known))
            result_.notes.push_back(
                fmt::format("{} names a scene \"{}\" that is not among the chosen ones", options_.bounds.string(), scene));
    }

    void judgeTimes(const MeasuredProgram& base, const MeasuredProgram& head) {
        std::vector<TimedCell> cells = cells_.timedCells(base, head);
        const std::size_t all = cells.size();
        std::erase_if(cells, [&](const TimedCell& cell) {
            return isKnown(reachable(base), head.build(), cell.variant, sceneId(cell.scene));
        });
        noteKnown("times", all - cells.size(), all);
        if (all == 0 && leftOut_ == 0) {
            result_.notes.emplace_back("time is not compared: none of the chosen cells is timed");
            return;
        }
        if (cells.empty()) return;
        StageLine line("time", options_.quiet);
        PairedOptions paired;
        paired.profile = options_.profile;
        paired.rule = cells_.policy.time;
        const std::vector<TimeJudgement> judgements = timed(
            "time in pairs", [&] { return judgePairedTime(base.file(), head.file(), cells, paired, line.progress()); });
        for (const TimeJudgement& judgement : judgements) addTime(judgement, paired.rule);
    }

    void addTime(const TimeJudgement& judgement, const TimeRule& rule) {
        const std::string scene = sceneId(judgement.cell.scene), variant = judgement.cell.variant;
        const std::string figures =
            fmt::format("{} on {}: a frame takes {:.3f} of the base's CPU time", variant, scene, judgement.ratio);
        const std::string told = fmt::format("; {:.1f} % or more would have been told", 100 * judgement.smallestTold);
        Change change{scene,           variant,    "time.ratio",    Class::Time,   1,
                      judgement.ratio, rule.floor, Direction::Same, figures + told};
        if (judgement.controlAlarm) {
            change.direction = Direction::NotCompared;
            change.sentence =
                fmt::format("{}, but the base against itself differs, too: the machine is not steady enough", figures);
        } else if (judgement.verdict == TimeVerdict::Slower) {
            change.direction = Direction::Worse;
            change.sentence = fmt::format("{}, surely more than {:.3f}", figures, judgement.lowerBound);
        } else if (judgement.verdict == TimeVerdict::Unclear) {
            const bool tells = judgement.smallestTold < rule.mustTell;
            change.direction = tells ? Direction::Unclear : Direction::NotCompared;
            change.sentence = fmt::format("{}, which {} rounds leave uncertain{}", figures, judgement.rounds, told);
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
        std::ranges::move(waive(result_.changes, cells_.policy.config.waivers, today()), std::back_inserter(result_.notes));
        result_.changes = oneAShader(std::move(result_.changes));
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
        if (r.profile != name(options_.profile) || r.seed < options_.seed || r.seed >= options_.seed + seedsOfChance)
            return false;
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
    std::size_t leftOut_ = 0; // cells that are measured on neither side
};

} // namespace

fs::path shaderFolder(const GateOptions& options) { return options.out / "shader-cost"; }

ExitCode GateResult::code() const { return notCompared.empty() ? verdictOf(changes) : ExitCode::Inconclusive; }

GateResult comparedRecords(const std::vector<Record>& base, const std::vector<Record>& head, bool sameProgram) {
    GateResult result;
    static_cast<Comparison&>(result) = compare(base, head);
    const auto nameOf = [](const std::vector<Record>& records) {
        return records.empty() ? std::string("no records") : records.front().commit;
    };
    result.base = nameOf(base);
    result.head = nameOf(head);
    if (const auto why = whyMeaningless(base, head, sameProgram)) result.notCompared.push_back(*why);
    return result;
}

GateResult gate(const GateOptions& options) {
    const auto start = Clock::now();
    GateResult result = Gate(options).judge();
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

} // namespace shadowbench::gate
