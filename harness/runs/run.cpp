#include "harness/runs/run.h"

#include "base/files.h"
#include "base/limits.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress_line.h"
#include "base/trace.h"
#include "base/worker_processes.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/environment.h"
#include "harness/cells/instruction_costs.h"
#include "harness/cells/scene_cells.h"
#include "harness/inspect/inspection.h"
#include "harness/measure/callgrind.h"
#include "harness/render/shared_shaders.h"
#include "harness/runs/kept_cells.h"
#include "scene/load/load.h"
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
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace shadowbench {
namespace {

using shards::MeasuredCell;

/// Calls `work`; what it throws becomes the record of a failed cell.
MeasuredCell runGuarded(const SceneCells& cells, const techniques::Variant& variant, Record record,
                        const std::function<void(Record&)>& work) {
    const auto failed = [&](const Error& error) {
        return MeasuredCell{"", cells.failed(variant, record.cell, error), error.code(), error.isTransient()};
    };
    try {
        work(record);
        return {"", std::move(record)};
    } catch (const Error& error) {
        return failed(error);
    } catch (const std::bad_alloc&) {
        return failed(InternalError("there was not enough memory; run fewer cells at once with --jobs", Failure::Transient));
    } catch (const std::exception& unforeseen) { // of a library, such as of a thread that cannot be started
        return failed(InternalError(unforeseen.what()));
    }
}

class Runner {
public:
    explicit Runner(const RunOptions& options)
        : options_(options), variants_(chosenVariants(options.techniques, options.measure.external.get())),
          scenes_(chosenScenes(options.scenes, options.profile)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache), known_(cellCount()) {
        if (options.instructions) timing::valgrindVersion(); // to fail before the long part
        requireContext();
        std::error_code failed;
        std::filesystem::create_directories(options.out, failed);
        if (failed)
            throw InternalError(fmt::format("making the output folder {} failed: {}; choose another with --out",
                                            options.out.string(), failed.message()));
        warnOfScenes();
    }

    RunResult whole() {
        RecordsFile kept(options_, cellCount());
        std::vector<std::size_t> cells(cellCount());
        std::iota(cells.begin(), cells.end(), std::size_t{0});
        measure(cells, kept);
        if (options_.instructions) addInstructions();
        return {records(), code_};
    }

    shards::Measured part(const std::vector<shards::ManifestCell>& manifest, shards::CellRange range) {
        CellFiles kept(options_, manifest);
        std::vector<std::size_t> open;
        for (std::size_t cell = range.first; cell < range.last; ++cell)
            if (!kept.isFinished(cell)) open.push_back(cell);
        const std::size_t cells = range.last - range.first;
        measure(open, kept);
        try {
            if (options_.instructions) addInstructions();
        } catch (const Error& error) {
            for (const std::size_t cell : open) {
                if (!known_[cell] || shards::hasCost(*known_[cell], "instructions")) continue;
                Record record = *known_[cell];
                record.status = Status::Error;
                record.reason = error.what();
                keep(cell, {"", std::move(record), error.code(), error.isTransient()});
            }
        }
        return {cells, cells - open.size(), std::move(errors_), std::move(transient_)};
    }

private:
    void measure(const std::vector<std::size_t>& cells, KeptCells& kept) {
        cells_ = cells;
        kept_ = &kept;
        for (const std::size_t cell : cells_) ++unscored_[sceneIndex(cell)];
        const MissingTruths missing = missingTruths();
        if (!missing.empty()) sayNeed(missing.size());
        // What the first scene scores is told before the truths of others are computed.
        const std::span whole(cells_);
        const auto others =
            std::ranges::find_if(cells_, [&](auto cell) { return sceneIndex(cell) != sceneIndex(cells_[0]); });
        const bool othersWait =
            others != cells_.end() && !missing.empty() && std::get<0>(*missing.rbegin()) >= sceneIndex(*others);
        const std::size_t first = othersWait ? others - cells_.begin() : 0;
        for (const auto part : {whole.first(first), whole.subspan(first)}) {
            computeTruths(missing, part);
            scoreCells(part);
        }
        for (const auto& [cell, how] : lost_) keepScored(cell, lost(cell, how));
        if (options_.measure.timed()) timeCells();
    }

    /// Fails before the long part where nothing draws. OSMesa needs no more than to be there; EGL is tried in a process of
    /// its own, since drivers of graphics processors do not outlive a fork.
    void requireContext() const {
        const Span span("setup", "context");
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

    /// Before the long part, of scenes that are not built in: a black picture scores as well as a right one.
    void warnOfScenes() const {
        const Span span("setup", "warnings");
        const std::vector<std::string> names = chosenSceneNames(options_.scenes), known = builtinScenes();
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (std::ranges::find(known, names[i]) != known.end()) continue;
            try {
                for (const inspect::Warning& warning : inspect::warningsOf(scenes_[i]))
                    fmt::print(stderr, "{}: {}\n", scenes_[i].id, inspect::lineOf(warning));
            } catch (const Error&) { // the cells will meet it, too, and say so
            }
        }
    }

    [[nodiscard]] std::size_t cellCount() const { return scenes_.size() * variants_.size(); }
    [[nodiscard]] std::size_t sceneIndex(std::size_t cell) const { return cell / variants_.size(); }
    [[nodiscard]] const Scene& sceneOf(std::size_t cell) const { return scenes_[sceneIndex(cell)]; }
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

    using MissingTruths = std::set<std::tuple<std::size_t, Truth, int>>; // scene, truth, frame

    MissingTruths missingTruths() {
        const Span span("truth", "keys");
        MissingTruths missing;
        for (const std::size_t cell : cells_) {
            const SceneCells& cells = cellsOf(sceneOf(cell));
            if (cells.notApplicable(variantOf(cell))) continue;
            for (const auto& [truth, frame] : cells.truthsOf(variantOf(cell)))
                if (!cells.isKept(truth, frame)) missing.emplace(sceneIndex(cell), truth, frame);
        }
        shared_.reset();
        return missing;
    }

    /// Of the scenes of `cells`. The long part of an empty cache: each truth by one process, while others compute others.
    void computeTruths(const MissingTruths& missing, std::span<const std::size_t> cells) {
        struct Asked {
            const Scene* scene;
            Truth truth;
            int frame;
        };
        if (cells.empty()) return;
        std::vector<Asked> asked;
        for (const auto& [scene, truth, frame] : missing)
            if (scene >= sceneIndex(cells.front()) && scene <= sceneIndex(cells.back()))
                asked.push_back({&scenes_[scene], truth, frame});
        if (asked.empty()) return;
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
                   cells_.size(), truths, workers(), inBytes(most), inBytes(memoryThere()));
    }

    /// Everything but costs that other programs would disturb, in as many processes as the machine runs at once.
    void scoreCells(std::span<const std::size_t> cells) {
        ProgressLine line("cells", static_cast<int>(cells.size()), options_.quiet);
        int done = 0;
        SharedWork work;
        work.items = cells.size();
        work.work = [&](std::size_t i, const Progress& progress) { return shards::text(scored(cells[i], progress)); };
        work.leave = [this] {
            const Span span("setup", "release");
            shared_.reset();
            context_.reset();
        };
        work.progress = [&](std::size_t i, double share, std::string_view what) {
            const std::size_t cell = cells[i];
            line.show(done, share, what.empty() ? nameOf(cell) : fmt::format("{} {}", sceneOf(cell).id, what));
        };
        work.finished = [&](std::size_t i, const std::string& answer) {
            ++done;
            keepScored(cells[i], shards::measuredCell(answer), &line);
        };
        work.lost = [&](std::size_t i, const std::string& how) {
            ++done;
            lost_.emplace(cells[i], how);
        };
        work.limit = [&](std::size_t i) { return longestFor(sceneOf(cells[i]), variantOf(cells[i])) * drawings(); };
        shareAmongProcesses(workers(), work);
        line.show(done, 0, "");
    }

    /// Tells of its scene, too, if that was its last cell, and all before are told; `line` is what is shown meanwhile.
    void keepScored(std::size_t cell, MeasuredCell measured, ProgressLine* line = nullptr) {
        keep(cell, std::move(measured));
        for (--unscored_[sceneIndex(cell)]; !unscored_.empty() && unscored_.begin()->second == 0;
             unscored_.erase(unscored_.begin())) {
            if (!options_.sceneScored) continue;
            std::vector<Record> records;
            for (const std::size_t other : cells_)
                if (sceneIndex(other) == unscored_.begin()->first) records.push_back(*known_[other]);
            if (line != nullptr) line->clear();
            options_.sceneScored(records);
        }
    }

    /// How often a cell is drawn, at most.
    [[nodiscard]] int drawings() const {
        return options_.measure.seeds + options_.measure.views - 1 + (options_.measure.neighbours ? 2 : 0);
    }

    /// In a worker.
    MeasuredCell scored(std::size_t cell, const Progress& progress) {
        const Span span("cell", variantOf(cell).name, sceneOf(cell).id);
        makeContext();
        SceneCells& cells = cellsOf(sceneOf(cell));
        const techniques::Variant& variant = variantOf(cell);
        Record blank = cells.blank(variant);
        if (blank.status == Status::NotApplicable) return {"", std::move(blank)};
        return runGuarded(cells, variant, std::move(blank), [&](Record& record) {
            record.cell = cells.id(variant);
            if (auto same = kept_->find(cell, record))
                record = std::move(same->record);
            else
                cells.score(variant, record, progress);
        });
    }

    MeasuredCell lost(std::size_t cell, const std::string& how) {
        makeContext();
        const InternalError error = lostCell(how);
        return {"", cellsOf(sceneOf(cell)).failed(variantOf(cell), "", error), error.code(), error.isTransient()};
    }

    /// One after the other: a frame's time wants the machine for itself.
    void timeCells() {
        std::vector<std::string> times = shards::costsOf(options_);
        std::erase(times, "instructions");
        std::vector<std::size_t> untimed;
        for (const std::size_t cell : cells_)
            if (known_[cell] && !shards::hasCosts(*known_[cell], times)) untimed.push_back(cell);
        if (untimed.empty()) return;
        makeContext();
        ProgressLine line("times", static_cast<int>(untimed.size()), options_.quiet);
        for (int done = 0; const std::size_t cell : untimed) {
            const Span span("cell", variantOf(cell).name, sceneOf(cell).id);
            line.show(done++, 0, nameOf(cell));
            SceneCells& cells = cellsOf(sceneOf(cell));
            const techniques::Variant& variant = variantOf(cell);
            keep(cell, runGuarded(cells, variant, *known_[cell], [&](Record& record) { cells.time(variant, record); }));
        }
        line.show(static_cast<int>(untimed.size()), 0, "");
    }

    void makeContext() {
        if (context_) return;
        const Span span("setup", "context");
        context_ = contextOfRun(cache_.folder(), false);
    }

    void addInstructions() {
        const Span span("cost", "instructions");
        InstructionOptions options{{}, options_.profile, options_.quiet};
        const std::vector<std::string> names = chosenSceneNames(options_.scenes);
        for (std::size_t i = 0; i < scenes_.size(); ++i) options.scenes[scenes_[i].id] = names[i];
        std::vector<Record> counted = records();
        const auto keepCounted = [&] {
            auto record = counted.cbegin();
            for (const std::size_t cell : cells_) {
                if (!known_[cell]) continue;
                const bool failed = record->status == Status::Error && known_[cell]->status != Status::Error;
                if (failed || record->values["cost.instructions"] != known_[cell]->values["cost.instructions"])
                    keep(cell, {"", *record, failed ? ExitCode::Internal : ExitCode::Pass});
                ++record;
            }
        };
        countInstructions(counted, options, keepCounted);
    }

    /// It is on disk before the next one is.
    void keep(std::size_t cell, MeasuredCell measured) {
        const Span span("files", "records");
        if (measured.code != ExitCode::Pass) {
            (measured.transient ? transient_ : errors_)
                .push_back(fmt::format("{} on {}: {}", variantOf(cell).name, sceneOf(cell).id, measured.record.reason));
            if (code_ == ExitCode::Pass) code_ = measured.code;
        }
        known_[cell] = measured.record;
        kept_->keep(cell, std::move(measured));
    }

    /// Of the cells that are known, in order.
    [[nodiscard]] std::vector<Record> records() const {
        std::vector<Record> records;
        for (const std::size_t cell : cells_)
            if (known_[cell]) records.push_back(*known_[cell]);
        return records;
    }

    RunOptions options_;
    std::vector<techniques::Variant> variants_;
    std::vector<Scene> scenes_;
    groundtruth::Cache cache_;
    std::vector<std::size_t> cells_;              // that are measured, rising
    std::map<std::size_t, std::size_t> unscored_; // cells to come, by scene index; without scenes that were told of
    std::map<std::size_t, std::string> lost_;     // cells whose worker ended, with how it did
    KeptCells* kept_ = nullptr;
    std::vector<std::optional<Record>> known_; // of each cell, once it is known
    ExitCode code_ = ExitCode::Pass;
    std::vector<std::string> errors_, transient_; // a sentence for each cell that failed
    std::unique_ptr<gl::Context> context_;        // of a worker, later of this process
    std::optional<std::pair<const Scene*, SceneCells>> shared_;
};

} // namespace

RunResult run(const RunOptions& options) { return Runner(options).whole(); }

shards::Measured shards::measureCells(const RunOptions& options, const std::vector<ManifestCell>& manifest,
                                      CellRange range) {
    RunOptions alone = options;
    if (alone.jobs == 0) alone.jobs = 1; // several parts share a machine
    return Runner(alone).part(manifest, range);
}

} // namespace shadowbench
