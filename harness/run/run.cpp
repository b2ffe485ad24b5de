#include "harness/run/run.h"

#include "harness/lod/lod_cell.h"
#include "harness/lod/lod_images.h"
#include "harness/run/cell.h"
#include "harness/run/cell_images.h"
#include "harness/run/environment.h"
#include "harness/run/instruction_costs.h"
#include "harness/run/progress_line.h"
#include "harness/timing/callgrind.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace shadowbench {
namespace {

std::vector<techniques::Variant> chosenVariants(const std::vector<std::string>& patterns) {
    std::vector<techniques::Variant> variants;
    for (const std::string& pattern : patterns.empty() ? std::vector<std::string>{"*"} : patterns)
        for (techniques::Variant& variant : techniques::matchVariants(pattern)) {
            const bool known =
                std::any_of(variants.begin(), variants.end(), [&](const auto& v) { return v.name == variant.name; });
            if (!known) variants.push_back(std::move(variant));
        }
    return variants;
}

std::vector<Scene> chosenScenes(const RunOptions& options) {
    std::vector<Scene> scenes;
    for (const std::string& id : options.scenes.empty() ? standardScenes() : options.scenes)
        scenes.push_back(loadScene(id, options.profile));
    return scenes;
}

/// The records of an unfinished run that need not be made again.
std::vector<Record> finishedRecords(const RunOptions& options) {
    const std::filesystem::path file = options.out / "results.jsonl";
    if (!options.resume || !std::filesystem::exists(file)) return {};
    std::vector<Record> records = readRecords(file);
    std::erase_if(records, [](const Record& r) { return r.status == Status::Error || r.commit != builtFrom().hash; });
    return records;
}

class Runner {
public:
    explicit Runner(const RunOptions& options)
        : options_(options), variants_(chosenVariants(options.techniques)), scenes_(chosenScenes(options)),
          finished_(finishedRecords(options)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache),
          context_(gl::Context::create()) {
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
        Stage stage(scene);
        Truths truths(scene, cache_);
        lod::LodScene lodScene(scene);
        int done = 0;
        for (const techniques::Variant& variant : variants_) {
            line.show(done, 0, variant.name);
            keep(cell(scene, stage, truths, lodScene, variant,
                      [&](double share, std::string_view what) { line.show(done, share, what); }));
            ++done;
        }
        line.show(done, 0, "");
    }

    Record cell(const Scene& scene, Stage& stage, Truths& truths, lod::LodScene& lodScene,
                const techniques::Variant& variant, const Progress& progress) {
        Record record = blankRecord(scene, variant, options_.seed);
        const bool isLod = variant.isLod();
        if (const auto reason = isLod ? lod::notApplicable(scene) : notApplicable(scene, variant)) {
            record.status = Status::NotApplicable;
            record.reason = *reason;
            return record;
        }
        try {
            record.cell = isLod ? lod::lodCellId(scene, variant) : cellId(truths, scene, variant, options_.seed);
            if (const Record* same = finishedAlready(record.cell)) return *same;
            if (isLod) {
                runLod(lodScene, variant, record, progress);
                return record;
            }
            computeTruths(scene, truths, variant, progress);
            CellOptions cellOptions;
            cellOptions.seed = options_.seed;
            cellOptions.cost.time = options_.time;
            CellImages images;
            progress(0, variant.name);
            runCell(scene, stage, truths, variant, cellOptions, record, images);
            if (options_.images) writeCellImages(options_.out / "images" / scene.id / fileName(variant.name), images);
            return record;
        } catch (const Error& error) {
            Record failed = blankRecord(scene, variant, options_.seed);
            failed.cell = record.cell;
            failed.status = Status::Error;
            failed.reason = error.what();
            if (result_.code == ExitCode::Pass) result_.code = error.code();
            return failed;
        }
    }

    void runLod(lod::LodScene& lodScene, const techniques::Variant& variant, Record& record,
                const Progress& progress) const {
        lod::LodCellOptions cellOptions;
        cellOptions.time = options_.time;
        lod::KeepPicture keep;
        std::optional<lod::LodImages> images;
        if (options_.images) {
            images.emplace(lodScene.reference(progress));
            keep = [&images](int frame, const metrics::ColourImage& picture) { images->keep(frame, picture); };
        }
        lod::runLodCell(lodScene, variant, cellOptions, record, progress, keep);
        if (images) images->write(options_.out / "images" / record.scene / fileName(variant.name));
    }

    /// References first, with their own progress: they are the long part of an empty cache.
    static void computeTruths(const Scene& scene, Truths& truths, const techniques::Variant& variant,
                              const Progress& progress) {
        const bool soft = variant.entry->answer == techniques::Answer::Soft;
        for (const int frame : truths.scoredFrames()) {
            const std::string what = fmt::format("truth of frame {}", frame);
            const auto show = [&](double share, std::string_view) { progress(share, what); };
            truths.at(soft ? Truth::Soft : Truth::Hard, frame, show);
            if (scene.light.isArea() && frame == scene.timeline.still - 1) truths.at(Truth::Soft, frame, show);
        }
    }

    const Record* finishedAlready(const std::string& cell) const {
        const auto found = std::find_if(finished_.begin(), finished_.end(), [&](const Record& r) { return r.cell == cell; });
        return found == finished_.end() ? nullptr : &*found;
    }

    void addInstructions() {
        InstructionOptions options{{}, options_.profile, options_.quiet};
        for (std::size_t i = 0; i < scenes_.size(); ++i)
            options.scenes[scenes_[i].id] = options_.scenes.empty() ? scenes_[i].id : options_.scenes[i];
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
