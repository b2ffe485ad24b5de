#include "cli/reference.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include "base/progress_line.h"
#include "cli/written_report.h"
#include "groundtruth/certify/agreement.h"
#include "groundtruth/store/cache.h"
#include "groundtruth/store/golden.h"
#include "report/truth_report.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

report::TruthOfScene truthOf(const Scene& scene, int frame, const groundtruth::Cache& cache, bool quiet) {
    const std::vector<Truth> truths = truthsOf(scene.light);
    ProgressLine line(scene.id, static_cast<int>(2 * truths.size()), quiet);
    int done = 0;
    const auto step = [&](const std::string& what) {
        line.show(done, 0, what);
        return [&line, what, at = done++](double share, std::string_view) { line.show(at, share, what); };
    };
    report::TruthOfScene result{scene.id, scene.title, scene.shows, std::string(name(scene.profile)), frame, {}, {}};
    for (const Truth truth : truths) {
        const groundtruth::Request request = referenceRequest(scene, truth, frame);
        const std::string kind(name(truth));
        result.references.push_back({kind, groundtruth::cached(cache, request, step(kind + " reference"))});
        const groundtruth::Reference& reference = result.references.back().reference;
        requireGolden(committedContents(), reference.provenance.key, contentOf(contentHashes(reference)));
        if (truth == Truth::PixelArea) continue; // its certificate says how it agrees with exact rays
        for (groundtruth::Agreement& agreement : groundtruth::oracleAgreement(request, step("agreement on " + kind)))
            result.agreements.push_back(std::move(agreement));
    }
    line.show(done, 0, "");
    return result;
}

} // namespace

ExitCode reportOnTruth(const ReferenceOptions& options) {
    const groundtruth::Cache cache(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache);
    std::vector<report::TruthOfScene> scenes;
    for (const std::string& id : options.scenes.empty() ? standardScenes() : options.scenes) {
        const Scene scene = loadScene(id, options.profile, metrics::boundedMetrics());
        scenes.push_back(truthOf(scene, frameOf(scene, options), cache, options.quiet));
    }
    printFiles(report::writeTruthReport(scenes, options.report));
    return ExitCode::Pass;
}

} // namespace shadowbench
