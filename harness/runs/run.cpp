#include "harness/runs/run.h"

#include "base/progress_line.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/environment.h"
#include "harness/cells/instruction_costs.h"
#include "harness/cells/scene_cells.h"
#include "harness/measure/callgrind.h"
#include "harness/render/shared_shaders.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {
namespace {

/// The records of an unfinished run that need not be made again.
std::vector<Record> finishedRecords(const RunOptions& options) {
    const std::filesystem::path file = options.out / "results.jsonl";
    if (!options.resume || !std::filesystem::exists(file)) return {};
    std::vector<Record> records = readRecords(file);
    std::erase_if(records, [](const Record& r) {
        return r.status == Status::Error || r.commit != builtFrom().hash || r.program != programHash();
    });
    return records;
}

class Runner {
public:
    explicit Runner(const RunOptions& options)
        : options_(options), variants_(chosenVariants(options.techniques)),
          scenes_(chosenScenes(options.scenes, options.profile)), finished_(finishedRecords(options)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache),
          context_(contextOfRun(cache_.folder(), options.measure.timed())) {
        if (options.instructions) timing::valgrindVersion(); // to fail before the long part
        std::error_code failed;
        std::filesystem::create_directories(options.out, failed);
        if (failed)
            throw InternalError(fmt::format("making the output folder {} failed: {}; choose another with --out",
                                            options.out.string(), failed.message()));
    }

    RunResult all() {
        for (const Scene& scene : scenes_) runScene(scene);
        if (options_.instructions) addInstructions();
        return std::move(result_);
    }

private:
    void runScene(const Scene& scene) {
        ProgressLine line(scene.id, static_cast<int>(variants_.size()), options_.quiet);
        SceneCells cells(scene, cache_, options_.measure);
        int done = 0;
        for (const techniques::Variant& variant : variants_) {
            line.show(done, 0, variant.name);
            keep(cell(cells, variant, [&](double share, std::string_view what) { line.show(done, share, what); }));
            ++done;
        }
        line.show(done, 0, "");
    }

    Record cell(SceneCells& cells, const techniques::Variant& variant, const Progress& progress) {
        Record record = cells.blank(variant);
        if (record.status == Status::NotApplicable) return record;
        try {
            record.cell = cells.id(variant);
            if (const Record* same = finishedAlready(record.cell)) return *same;
            cells.measure(variant, record, progress);
            return record;
        } catch (const Error& error) {
            if (result_.code == ExitCode::Pass) result_.code = error.code();
            return cells.failed(variant, record.cell, error);
        }
    }

    const Record* finishedAlready(const std::string& cell) const {
        const auto found = std::find_if(finished_.begin(), finished_.end(), [&](const Record& r) { return r.cell == cell; });
        return found == finished_.end() ? nullptr : &*found;
    }

    void addInstructions() {
        InstructionOptions options{{}, options_.profile, options_.quiet};
        const std::vector<std::string> names = chosenSceneNames(options_.scenes);
        for (std::size_t i = 0; i < scenes_.size(); ++i) options.scenes[scenes_[i].id] = names[i];
        countInstructions(result_.records, options, [this] { writeAll(); });
        const bool failed = std::any_of(result_.records.begin(), result_.records.end(),
                                        [](const Record& r) { return r.status == Status::Error; });
        if (failed && result_.code == ExitCode::Pass) result_.code = ExitCode::Internal;
    }

    /// Every finished cell is on disk before the next one starts.
    void keep(Record record) {
        result_.records.push_back(std::move(record));
        writeAll();
    }

    void writeAll() const {
        std::vector<Record> all = result_.records;
        for (const Record& earlier : finished_) {
            const bool again = std::any_of(all.begin(), all.end(), [&](const Record& r) {
                return r.scene == earlier.scene && r.variant == earlier.variant && r.profile == earlier.profile;
            });
            if (!again) all.push_back(earlier);
        }
        writeRecords(options_.out / "results.jsonl", all);
    }

    RunOptions options_;
    std::vector<techniques::Variant> variants_;
    std::vector<Scene> scenes_;
    std::vector<Record> finished_;
    groundtruth::Cache cache_;
    std::unique_ptr<gl::Context> context_;
    RunResult result_;
};

} // namespace

RunResult run(const RunOptions& options) { return Runner(options).all(); }

} // namespace shadowbench
