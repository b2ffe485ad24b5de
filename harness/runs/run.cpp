#include "harness/runs/run.h"

#include "base/files.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress_line.h"
#include "base/worker_processes.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/environment.h"
#include "harness/cells/instruction_costs.h"
#include "harness/cells/scene_cells.h"
#include "harness/measure/callgrind.h"
#include "harness/records/comparability.h"
#include "harness/render/shared_shaders.h"
#include "harness/runs/cell_file.h"
#include "scene/load/memory_need.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <utility>

namespace shadowbench {
namespace {

using shards::MeasuredCell;

/// The records of an earlier run of this program into the same folder.
std::vector<Record> earlierRecords(const RunOptions& options) {
    const std::filesystem::path file = options.out / "results.jsonl";
    if (!options.resume || !std::filesystem::exists(file)) return {};
    std::vector<Record> records = readRecords(file);
    std::erase_if(records, [](const Record& r) { return r.commit != builtFrom().hash || r.program != programHash(); });
    return records;
}

/// A record as a line of results.jsonl.
std::string lineOf(const Record& record) { return toJson(record) + "\n"; }

std::vector<std::string> linesOf(const std::vector<Record>& records) {
    std::vector<std::string> lines(records.size());
    std::ranges::transform(records, lines.begin(), lineOf);
    return lines;
}

bool isSameCell(const Record& a, const Record& b) {
    return a.scene == b.scene && a.variant == b.variant && a.profile == b.profile;
}

/// Whether all times that are asked for have been taken; of other renderers none are.
bool isTimed(const Record& record, const MeasureOptions& options) {
    if (isExternal(record)) return true;
    const bool own = record.values["cost.time.median"] || record.values["lod.time.median"];
    return (own || !options.time) && (record.otherScreen || isLevelOfDetail(record) || !options.otherScreen);
}

/// Calls `work`; what it throws becomes the record of a failed cell.
MeasuredCell runGuarded(const SceneCells& cells, const techniques::Variant& variant, Record record,
                        const std::function<void(Record&)>& work) {
    try {
        work(record);
        return {"", std::move(record), ExitCode::Pass};
    } catch (const Error& error) {
        return {"", cells.failed(variant, record.cell, error), error.code()};
    } catch (const std::bad_alloc&) {
        const InternalError error("there was not enough memory; run fewer cells at once with --jobs");
        return {"", cells.failed(variant, record.cell, error), error.code()};
    } catch (const std::exception& unforeseen) { // of a library, such as of a thread that cannot be started
        const InternalError error(unforeseen.what());
        return {"", cells.failed(variant, record.cell, error), error.code()};
    }
}

class Runner {
public:
    explicit Runner(const RunOptions& options)
        : options_(options), variants_(chosenVariants(options.techniques, options.measure.external.get())),
          scenes_(chosenScenes(options.scenes, options.profile)), earlier_(earlierRecords(options)),
          earlierLines_(linesOf(earlier_)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache), known_(cellCount()),
          lines_(cellCount()) {
        if (options.instructions) timing::valgrindVersion(); // to fail before the long part
        requireContext();
        std::error_code failed;
        std::filesystem::create_directories(options.out, failed);
        if (failed)
            throw InternalError(fmt::format("making the output folder {} failed: {}; choose another with --out",
                                            options.out.string(), failed.message()));
    }

    RunResult all() {
        computeTruths();
        scoreCells();
        if (options_.measure.timed()) timeCells();
        if (options_.instructions) addInstructions();
        return {records(), code_};
    }

private:
    /// Fails before the long part where nothing draws. OSMesa needs no more than to be there; EGL is tried in a process of
    /// its own, since drivers of graphics processors do not outlive a fork.
    void requireContext() const {
        if (gl::drawsWithOsMesa()) return;
        try {
            checkInOwnProcess([this] {
                const auto context = gl::Context::create();
                if (options_.instructions) timing::requireCountable(context->info());
            });
        } catch (const Error& error) {
            throw Inconclusive(error.what());
        }
    }

    [[nodiscard]] std::size_t cellCount() const { return scenes_.size() * variants_.size(); }
    [[nodiscard]] const Scene& sceneOf(std::size_t cell) const { return scenes_[cell / variants_.size()]; }
    [[nodiscard]] const techniques::Variant& variantOf(std::size_t cell) const { return variants_[cell % variants_.size()]; }
    [[nodiscard]] std::string nameOf(std::size_t cell) const { return sceneOf(cell).id + " " + variantOf(cell).name; }
    [[nodiscard]] int workers() const { return options_.jobs > 0 ? options_.jobs : availableThreads(); }

    /// What cells of `scene` share in this process: made for the first, kept until another scene is asked for.
    SceneCells& cellsOf(const Scene& scene) {
        if (shared_ && shared_->first == &scene) return shared_->second;
        shared_.reset();
        return shared_
            .emplace(std::piecewise_construct, std::forward_as_tuple(&scene),
                     std::forward_as_tuple(scene, cache_, options_.measure))
            .second;
    }

    /// The long part of an empty cache: each truth by one process, while others compute others.
    void computeTruths() {
        struct Asked {
            const Scene* scene;
            Truth truth;
            int frame;
        };
        std::vector<Asked> asked;
        for (const Scene& scene : scenes_) {
            std::set<std::pair<Truth, int>> ofScene;
            const SceneCells& cells = cellsOf(scene);
            for (const techniques::Variant& variant : variants_)
                if (!cells.notApplicable(variant)) ofScene.merge(missingTruths(cells, variant));
            for (const auto& [truth, frame] : ofScene) asked.push_back({&scene, truth, frame});
        }
        shared_.reset();
        if (asked.empty()) return;
        sayNeed(asked.size());
        ProgressLine line("truths", static_cast<int>(asked.size()), options_.quiet);
        int done = 0;
        SharedWork work;
        work.items = asked.size();
        work.work = [&](std::size_t item, const Progress& progress) {
            try {
                cellsOf(*asked[item].scene).computeTruth(asked[item].truth, asked[item].frame, progress);
            } catch (const std::exception&) { // the cells that need it will meet it, too, and say so
            }
            return std::string();
        };
        work.progress = [&](std::size_t item, double share, std::string_view what) {
            line.show(done, share, fmt::format("{} {}", asked[item].scene->id, what));
        };
        work.finished = [&](std::size_t, const std::string&) { ++done; };
        work.lost = [&](std::size_t, const std::string&) { ++done; };
        shareAmongProcesses(workers(), work);
    }

    /// What a person should know before a long wait.
    void sayNeed(std::size_t truths) const {
        if (options_.quiet) return;
        std::uint64_t most = 0;
        for (const Scene& scene : scenes_) most = std::max(most, leastMemory(scene));
        fmt::print(stderr,
                   "run: {} cells; {} truths are not in the cache and come first; each of up to {} processes takes {} of "
                   "memory or more, of {}\n",
                   cellCount(), truths, workers(), inBytes(most), inBytes(memoryThere()));
    }

    [[nodiscard]] std::set<std::pair<Truth, int>> missingTruths(const SceneCells& cells,
                                                                const techniques::Variant& variant) const {
        std::set<std::pair<Truth, int>> missing;
        for (const auto& [truth, frame] : cells.truthsOf(variant))
            if (!cells.isKept(truth, frame)) missing.emplace(truth, frame);
        return missing;
    }

    /// Everything but costs that other programs would disturb, in as many processes as the machine runs at once.
    void scoreCells() {
        ProgressLine line("cells", static_cast<int>(cellCount()), options_.quiet);
        int done = 0;
        SharedWork work;
        work.items = cellCount();
        work.work = [this](std::size_t cell, const Progress& progress) { return shards::text(scored(cell, progress)); };
        work.leave = [this] {
            shared_.reset();
            context_.reset();
        };
        work.progress = [&](std::size_t cell, double share, std::string_view what) {
            line.show(done, share, what.empty() ? nameOf(cell) : fmt::format("{} {}", sceneOf(cell).id, what));
        };
        work.finished = [&](std::size_t cell, const std::string& answer) {
            ++done;
            keep(cell, shards::measuredCell(answer));
        };
        work.lost = [&](std::size_t cell, const std::string& how) {
            ++done;
            lost_.emplace(cell, how);
        };
        shareAmongProcesses(workers(), work);
        line.show(done, 0, "");
        for (const auto& [cell, how] : lost_) keep(cell, lostCell(cell, how));
    }

    /// In a worker.
    MeasuredCell scored(std::size_t cell, const Progress& progress) {
        makeContext();
        SceneCells& cells = cellsOf(sceneOf(cell));
        const techniques::Variant& variant = variantOf(cell);
        Record blank = cells.blank(variant);
        if (blank.status == Status::NotApplicable) return {"", std::move(blank), ExitCode::Pass};
        return runGuarded(cells, variant, std::move(blank), [&](Record& record) {
            record.cell = cells.id(variant);
            if (const Record* same = finishedAlready(record))
                record = *same;
            else
                cells.score(variant, record, progress);
        });
    }

    MeasuredCell lostCell(std::size_t cell, const std::string& how) {
        makeContext();
        const InternalError error(fmt::format("the process that rendered it {}", how));
        return {"", cellsOf(sceneOf(cell)).failed(variantOf(cell), "", error), error.code()};
    }

    /// One after the other: a frame's time wants the machine for itself.
    void timeCells() {
        std::vector<std::size_t> untimed;
        for (std::size_t cell = 0; cell < known_.size(); ++cell)
            if (wasScored(known_[cell]->status) && !isTimed(*known_[cell], options_.measure)) untimed.push_back(cell);
        if (untimed.empty()) return;
        makeContext();
        ProgressLine line("times", static_cast<int>(untimed.size()), options_.quiet);
        for (int done = 0; const std::size_t cell : untimed) {
            line.show(done++, 0, nameOf(cell));
            SceneCells& cells = cellsOf(sceneOf(cell));
            const techniques::Variant& variant = variantOf(cell);
            keep(cell, runGuarded(cells, variant, *known_[cell], [&](Record& record) { cells.time(variant, record); }));
        }
        line.show(static_cast<int>(untimed.size()), 0, "");
    }

    void makeContext() {
        if (!context_) context_ = contextOfRun(cache_.folder(), false);
    }

    /// The cell's record of an earlier run that need not be made again: no error, and drawn by the same rasteriser.
    const Record* finishedAlready(const Record& cell) const {
        const auto found = std::find_if(earlier_.begin(), earlier_.end(), [&](const Record& r) {
            return r.status != Status::Error && r.cell == cell.cell &&
                   (isExternal(r) || !gate::difference(r.environment, cell.environment, gate::EnvironmentScope::OfScores));
        });
        return found == earlier_.end() ? nullptr : &*found;
    }

    void addInstructions() {
        InstructionOptions options{{}, options_.profile, options_.quiet};
        const std::vector<std::string> names = chosenSceneNames(options_.scenes);
        for (std::size_t i = 0; i < scenes_.size(); ++i) options.scenes[scenes_[i].id] = names[i];
        std::vector<Record> counted = records();
        countInstructions(counted, options, [&] {
            for (std::size_t cell = 0; cell < counted.size(); ++cell) lines_[cell] = lineOf(counted[cell]);
            writeLines();
        });
        for (std::size_t cell = 0; cell < known_.size(); ++cell) known_[cell] = counted[cell];
        const bool failed =
            std::any_of(counted.begin(), counted.end(), [](const Record& r) { return r.status == Status::Error; });
        if (failed && code_ == ExitCode::Pass) code_ = ExitCode::Internal;
    }

    /// Every finished cell is on disk before the next one is kept.
    void keep(std::size_t cell, MeasuredCell measured) {
        if (measured.code != ExitCode::Pass && code_ == ExitCode::Pass) code_ = measured.code;
        known_[cell] = std::move(measured.record);
        lines_[cell] = lineOf(*known_[cell]);
        for (std::size_t i = 0; i < earlier_.size(); ++i)
            if (isSameCell(earlier_[i], *known_[cell])) earlierLines_[i].clear();
        writeLines();
    }

    /// Of the cells that are known, in order, and then what an earlier run has left of others: errors, too, which are made
    /// again where they are chosen.
    void writeLines() const {
        std::string all;
        for (const auto& lines : {std::cref(lines_), std::cref(earlierLines_)})
            for (const std::string& line : lines.get()) all += line;
        writeFile(resultsFile(), all);
    }

    [[nodiscard]] std::filesystem::path resultsFile() const { return options_.out / "results.jsonl"; }

    /// Of the cells that are known, in order.
    [[nodiscard]] std::vector<Record> records() const {
        std::vector<Record> records;
        for (const std::optional<Record>& record : known_)
            if (record) records.push_back(*record);
        return records;
    }

    RunOptions options_;
    std::vector<techniques::Variant> variants_;
    std::vector<Scene> scenes_;
    std::vector<Record> earlier_;
    std::vector<std::string> earlierLines_; // of the same, empty once they are made again
    groundtruth::Cache cache_;
    std::vector<std::optional<Record>> known_; // of each cell, once it is known
    std::vector<std::string> lines_;           // of the same: each is written many times, with every cell that follows
    ExitCode code_ = ExitCode::Pass;
    std::map<std::size_t, std::string> lost_; // cells whose process ended, and how
    std::unique_ptr<gl::Context> context_;    // of a worker, later of this process
    std::optional<std::pair<const Scene*, SceneCells>> shared_;
};

} // namespace

RunResult run(const RunOptions& options) { return Runner(options).all(); }

} // namespace shadowbench
