#include "studies/sweep/viewport_curve.h"

#include "base/progress_line.h"
#include "harness/cells/cell.h"
#include "harness/cells/lod_cell.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::lod {
namespace {

using techniques::Variant;

std::vector<Variant> chosenVariants(const SweepOptions& options) {
    std::vector<Variant> variants;
    for (const std::string& pattern : options.techniques.empty() ? std::vector<std::string>{"lod-*"} : options.techniques)
        for (Variant& variant : techniques::matchVariants(pattern)) {
            const bool known = std::ranges::any_of(variants, [&](const Variant& v) { return v.name == variant.name; });
            if (variant.isLod() && !known) variants.push_back(std::move(variant));
        }
    if (variants.empty()) throw BadInput("none of the chosen techniques draws levels of detail; choose lod-*");
    return variants;
}

int sideOf(double value) {
    if (value != std::floor(value) || value < 16 || value > 8192)
        throw BadInput(fmt::format("a viewport is 16 to 8192 whole pixels wide, not {:g}", value));
    return static_cast<int>(value);
}

} // namespace

SweepResult viewportCurve(const SweepOptions& options, int frames) {
    const std::vector<Variant> variants = chosenVariants(options);
    Scene scene = loadScene(options.scene, options.profile, metrics::boundedMetrics());
    if (const auto reason = notApplicable(scene)) throw BadInput(*reason);
    scene.lod->frames = std::min(scene.lod->frames, frames);
    const std::vector<double> sizes =
        options.values.empty() ? std::vector<double>{128, 192, 256, 384, 512, 768, 1024} : options.values;
    for (const double size : sizes) sideOf(size);

    const auto context = gl::Context::create();
    ProgressLine line(fmt::format("{} over viewport", scene.id), static_cast<int>(sizes.size() * variants.size()),
                      options.quiet);
    std::vector<std::vector<Record>> curves(variants.size());
    int done = 0;
    for (const double size : sizes) {
        scene.size = glm::ivec2(sideOf(size));
        LodScene lodScene(scene);
        for (std::size_t i = 0; i < variants.size(); ++i) {
            const auto show = [&](double share, std::string_view what) {
                line.show(done, share, fmt::format("{}² {}", scene.size.x, what));
            };
            Record& record = curves[i].emplace_back(blankRecord(scene, variants[i], options.seed));
            record.cell = lodCellId(scene, variants[i]);
            record.sweep = SweepStep{viewportAxis, "pixels", variants[i].name, size, {}};
            scoreLodCell(lodScene, variants[i], record, show, {});
            timeLodCell(lodScene, variants[i], record);
            ++done;
        }
    }
    line.show(done, 0, "");
    SweepResult result;
    for (std::vector<Record>& curve : curves)
        for (Record& record : curve) result.records.push_back(std::move(record));
    return result;
}

} // namespace shadowbench::lod
