#include "harness/runs/measure_part.h"

#include "base/progress_line.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/instruction_costs.h"
#include "harness/cells/scene_cells.h"
#include "harness/measure/callgrind.h"
#include "harness/metrics/table.h"
#include "harness/render/shared_shaders.h"
#include "harness/runs/cell_file.h"
#include "scene/load/load.h"
#include "techniques/gl/context.h"

#include <exception>
#include <fmt/format.h>
#include <new>
#include <optional>

namespace shadowbench::shards {
namespace {

bool isValid(const std::filesystem::path& folder, const ManifestCell& cell) {
    try {
        const std::optional<MeasuredCell> known = readCell(folder, cell.id);
        return known && known->record.status != Status::Error && known->record.commit == cell.commit &&
               known->record.program == cell.program;
    } catch (const BadInput&) {
        return false; // it is replaced
    }
}

class Part {
public:
    Part(const RunOptions& options, const std::vector<ManifestCell>& manifest, CellRange range)
        : options_(options), manifest_(manifest), range_(range),
          variants_(chosenVariants(options.techniques, options.measure.external.get())),
          names_(chosenSceneNames(options.scenes)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache) {
        if (options.instructions) timing::valgrindVersion(); // to fail before the long part
    }

    Measured all() {
        const std::size_t perScene = variants_.size();
        for (std::size_t first = range_.first; first < range_.last;) {
            const std::size_t scene = first / perScene;
            const std::size_t last = std::min(range_.last, (scene + 1) * perScene);
            measureScene(scene, first, last);
            first = last;
        }
        return std::move(result_);
    }

private:
    /// Cells [first, last), all of one scene.
    void measureScene(std::size_t scene, std::size_t first, std::size_t last) {
        std::vector<std::size_t> open;
        for (std::size_t i = first; i < last; ++i)
            if (!isValid(options_.out, manifest_[i])) open.push_back(i);
        result_.cells += last - first;
        result_.kept += last - first - open.size();
        if (open.empty()) return;

        const Scene loaded = loadScene(names_[scene], options_.profile, metrics::boundedMetrics());
        if (!context_) context_ = contextOfRun(cache_.folder(), options_.measure.timed());
        SceneCells cells(loaded, cache_, options_.measure);
        ProgressLine line(loaded.id, static_cast<int>(open.size()), options_.quiet);
        int done = 0;
        for (const std::size_t i : open) {
            if (isValid(options_.out, manifest_[i])) { // another part that overlaps this one has measured it meanwhile
                ++result_.kept;
                line.show(++done, 0, "");
                continue;
            }
            const techniques::Variant& variant = variants_[i % variants_.size()];
            line.show(done, 0, variant.name);
            keep(cells, manifest_[i], names_[scene], variant,
                 [&](double share, std::string_view what) { line.show(done, share, what); });
            ++done;
        }
        line.show(done, 0, "");
    }

    /// Leaves the cell's file, or none and why.
    void keep(SceneCells& cells, const ManifestCell& cell, const std::string& sceneName, const techniques::Variant& variant,
              const Progress& progress) {
        const auto said = [&](std::string_view what) { return fmt::format("{} on {}: {}", cell.variant, cell.scene, what); };
        std::optional<MeasuredCell> measured;
        try {
            measured = {cell.id, record(cells, sceneName, variant, progress), ExitCode::Pass};
            if (measured->record.status == Status::Error) measured->code = ExitCode::Internal;
        } catch (const Error& error) {
            if (error.isTransient()) return result_.transient.push_back(said(error.what()));
            measured = {cell.id, cells.failed(variant, cells.id(variant), error), error.code()};
        } catch (const std::bad_alloc&) {
            return result_.transient.push_back(said("there was not enough memory"));
        } catch (const std::exception& unforeseen) { // of a library
            const InternalError error(unforeseen.what());
            measured = {cell.id, cells.failed(variant, cells.id(variant), error), error.code()};
        }
        if (measured->code != ExitCode::Pass) result_.errors.push_back(said(measured->record.reason));
        writeCell(options_.out, *measured);
    }

    Record record(SceneCells& cells, const std::string& sceneName, const techniques::Variant& variant,
                  const Progress& progress) const {
        Record record = cells.blank(variant);
        if (record.status == Status::NotApplicable) return record;
        record.cell = cells.id(variant);
        cells.measure(variant, record, progress);
        if (!options_.instructions) return record;
        std::vector<Record> one{std::move(record)};
        countInstructions(one, {{{one.front().scene, sceneName}}, options_.profile, true}, [] {});
        return std::move(one.front());
    }

    const RunOptions& options_;
    const std::vector<ManifestCell>& manifest_;
    CellRange range_;
    std::vector<techniques::Variant> variants_;
    std::vector<std::string> names_;
    groundtruth::Cache cache_;
    std::unique_ptr<gl::Context> context_;
    Measured result_;
};

} // namespace

Measured measureCells(const RunOptions& options, const std::vector<ManifestCell>& manifest, CellRange range) {
    return Part(options, manifest, range).all();
}

} // namespace shadowbench::shards
