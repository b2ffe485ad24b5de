#include "studies/causes/causes.h"

#include "base/image_io.h"
#include "base/progress_line.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/cell_selection.h"
#include "harness/render/shared_shaders.h"
#include "studies/recommend/caster_groups.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::causes {
namespace {

/// What casts in place of the scene's own; empty: these.
std::vector<Batch> otherCasters(const Scene& scene, const CausesOptions& options) {
    if (options.casterLevel == 0) return {};
    return castersAtLevel(scene, scene.timeline.still - 1, options.casterLevel);
}

/// One scene's rows, in order.
class SceneStudy {
public:
    SceneStudy(const Scene& scene, const groundtruth::Cache& cache, const CausesOptions& options)
        : options_(options), truths_(scene, cache), frames_(scene, truths_),
          casters_(otherCasters(scene, options)), result_{scene.id, {}, {}, {}} {}

    ExitCode explainRow(const techniques::Variant& row) {
        if (const auto reason = notApplicable(frames_.scene(), row)) {
            result_.withoutAnswer[row.name] = *reason;
            return ExitCode::Pass;
        }
        try {
            Explanation explanation = explain(frames_, row, options_.seed, casters_.empty() ? nullptr : &casters_);
            if (!explanation.isRight()) writePng(options_.out / pictureOf(explanation), causePicture(explanation));
            explanation.releasePixels();
            result_.rows.push_back(std::move(explanation));
        } catch (const Error& error) {
            result_.errors[row.name] = error.what();
            return error.code();
        }
        return ExitCode::Pass;
    }

    SceneCauses result() && { return std::move(result_); }

private:
    const CausesOptions& options_;
    Truths truths_;
    SceneFrames frames_;
    std::vector<Batch> casters_;
    SceneCauses result_;
};

void requireRows(const std::vector<SceneCauses>& scenes) {
    std::vector<std::string> reasons;
    for (const SceneCauses& scene : scenes) {
        if (!scene.rows.empty() || !scene.errors.empty()) return;
        for (const auto& [variant, reason] : scene.withoutAnswer)
            reasons.push_back(fmt::format("{} on {}: {}", variant, scene.scene, reason));
    }
    throw BadInput(fmt::format("no technique applies to its scene; {}", fmt::join(reasons, "; ")));
}

} // namespace

CausesResult explainAll(const CausesOptions& options) {
    std::vector<techniques::Variant> rows = chosenVariants(options.techniques, nullptr);
    std::erase_if(rows, &techniques::Variant::isLod);
    if (rows.empty())
        throw BadInput("causes are those of shadows, and level-of-detail techniques draw none: choose other techniques");
    const std::vector<Scene> scenes = chosenScenes(options.scenes, options.profile);
    for (const Scene& scene : scenes) (void)otherCasters(scene, options); // before anything is drawn
    const groundtruth::Cache cache(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache);
    const auto context = contextOfRun(cache.folder(), false);
    ProgressLine line("causes", static_cast<int>(rows.size() * scenes.size()), options.quiet);
    CausesResult result;
    int done = 0;
    for (const Scene& scene : scenes) {
        SceneStudy study(scene, cache, options);
        for (const techniques::Variant& row : rows) {
            line.show(done++, 0, fmt::format("{} {}", scene.id, row.name));
            const ExitCode code = study.explainRow(row);
            if (result.code == ExitCode::Pass) result.code = code;
        }
        result.scenes.push_back(std::move(study).result());
    }
    line.show(done, 0, "");
    requireRows(result.scenes);
    return result;
}

std::vector<Batch> castersAtLevel(const Scene& scene, int frame, int level) {
    const recommend::Casters casters(recommend::withChains(scene, {}), frame, {});
    recommend::Levels levels;
    for (const recommend::CasterGroup& group : casters.groups())
        levels.push_back(std::min(static_cast<std::size_t>(level), group.levels.size() - 1));
    return casters.cast(levels).batches;
}

std::filesystem::path pictureOf(const Explanation& explanation) {
    return std::filesystem::path(explanation.scene) / (fileName(explanation.variant) + ".png");
}

} // namespace shadowbench::causes
