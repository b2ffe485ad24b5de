#include "studies/develop/drawing.h"

#include "base/error.h"
#include "base/files.h"
#include "base/interrupts.h"
#include "base/limits.h"
#include "base/process.h"
#include "base/progress_line.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/kept_images.h"
#include "harness/cells/scene_cells.h"
#include "harness/records/record.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench::develop {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

struct ShownMetric {
    const char* name;
    metrics::MetricId id;
    bool isShare = false;
};
constexpr std::array shownMetrics{
    ShownMetric{"rmse", "accuracy.rmse"},          ShownMetric{"false shadow", "accuracy.false_shadow", true},
    ShownMetric{"leak", "accuracy.leak", true},    ShownMetric{"fragments", "cost.work.fragments"},
    ShownMetric{"vertices", "cost.work.vertices"}, ShownMetric{"draws", "cost.work.draws"},
    ShownMetric{"bytes", "cost.work.bytes"},
};

std::vector<Figure> figuresOf(const Record& record) {
    std::vector<Figure> figures;
    if (const auto ranked = headline(record)) figures.push_back({"error", ranked->metric == "mismatch", ranked->value});
    for (const ShownMetric& metric : shownMetrics)
        if (const auto value = record.values[metric.id]) figures.push_back({metric.name, metric.isShare, *value});
    return figures;
}

/// Places of the folder by their names in it alone.
std::string withoutFolder(std::string text, const fs::path& folder) {
    const std::string prefix = folder.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
        text.erase(at, prefix.size());
    return text;
}

Row rowOf(const Record& record, const fs::path& images, const fs::path& folder) {
    Row row{record.scene, record.variant, "", {}, nullptr};
    if (!wasScored(record.status)) {
        row.error = withoutFolder(record.reason, folder);
        return row;
    }
    const fs::path kept = cellFolder(images, record.scene, record.variant);
    row.figures = figuresOf(record);
    row.pictures = std::make_shared<const Pictures>(
        Pictures{readFile(kept / "visibility.png"), readFile(kept / "reference.png"), readFile(kept / "error.png")});
    return row;
}

std::vector<Row> rowsIn(const fs::path& out, const fs::path& folder) {
    std::vector<Row> rows;
    for (const shards::ManifestCell& cell : shards::readManifest(out))
        if (const auto measured = shards::readCell(out, cell.id))
            rows.push_back(rowOf(measured->record, out / "images", folder));
    return rows;
}

/// The program's last word, which it begins with its own name.
std::string errorIn(const std::string& line, const fs::path& folder) {
    constexpr std::string_view name = "shadowbench: ";
    return withoutFolder(line.starts_with(name) ? line.substr(name.size()) : line, folder);
}

Command commandOf(const Request& request, const fs::path& room) {
    Command command{fs::read_symlink("/proc/self/exe"), runWords(request), room, request.limit};
    for (const char* word : {"--shard", "1/1", "--cost", "none", "--quiet", "--cache"}) command.arguments.emplace_back(word);
    command.arguments.push_back(request.cache.string());
    command.arguments.insert(command.arguments.end(), {"--out", (room / "out").string()});
    command.inherited = techniques::inheritedVariables();
    command.inherited.emplace_back("SHADOWBENCH_THREADS");
    command.inherited.emplace_back(variableOf(Limit::CellSeconds));
    command.openFiles.reset(); // as for a run that the user starts
    command.memoryLimit.reset();
    return command;
}

} // namespace

std::vector<std::string> runWords(const Request& request) {
    std::vector<std::string> words{"run", "--technique-folder", request.folder.string()};
    for (const std::string& technique : request.techniques) words.insert(words.end(), {"--technique", technique});
    for (const std::string& scene : request.scenes) words.insert(words.end(), {"--scene", scene});
    if (request.profile != Profile::Gate) words.insert(words.end(), {"--profile", std::string(name(request.profile))});
    words.emplace_back("--images");
    return words;
}

void limitRows() { setenv(std::string(variableOf(Limit::CellSeconds)).c_str(), "10", 0); }

std::chrono::milliseconds limitFor(const std::vector<Scene>& scenes) {
    const double secondsAt256 = 6 * static_cast<double>(limitOf(Limit::CellSeconds));
    double seconds = 0;
    for (const Scene& scene : scenes) seconds += secondsAt256 * std::max(1.0, scene.size.x * scene.size.y / (256.0 * 256.0));
    return std::chrono::duration_cast<std::chrono::milliseconds>(Seconds(seconds));
}

void computeTruths(const std::vector<Scene>& scenes, const fs::path& folder) {
    const groundtruth::Cache cache(folder);
    for (const Scene& scene : scenes) {
        SceneCells cells(scene, cache, {});
        std::vector<std::pair<Truth, int>> missing;
        for (const auto& [truth, frame] : askedTruths(scene))
            if (!cells.isKept(truth, frame)) missing.emplace_back(truth, frame);
        if (missing.empty()) continue;
        ProgressLine line("truths", static_cast<int>(missing.size()), false);
        for (int done = 0; const auto& [truth, frame] : missing) {
            cells.computeTruth(truth, frame, [&](double share, std::string_view what) {
                line.show(done, share, fmt::format("{} {}", scene.id, what));
            });
            ++done;
        }
    }
}

std::optional<Drawing> draw(const Request& request, const fs::path& room, const std::function<bool()>& stops) {
    const auto start = std::chrono::steady_clock::now();
    fs::remove_all(room / "out");
    Command command = commandOf(request, room);
    command.stops = stops;
    std::string last;
    Drawing drawing;
    const Finished finished = runProcess(command, [&](std::string_view line) {
        last = line;
        if (constexpr std::string_view mark = "warning: "; line.starts_with(mark))
            drawing.warnings.push_back(withoutFolder(last.substr(mark.size()), request.folder));
    });
    if (finished.stopped) return std::nullopt;

    if (finished.timedOut)
        drawing.error = fmt::format("drawing took longer than {} s and was ended: shorten a shader's loops",
                                    std::chrono::duration_cast<std::chrono::seconds>(command.limit).count());
    else if (finished.signal != 0)
        drawing.error = fmt::format("drawing was ended by signal {}", finished.signal);
    else if (finished.exitCode != 0)
        drawing.error = errorIn(last, request.folder);
    else
        drawing.rows = rowsIn(room / "out", request.folder);
    drawing.seconds = Seconds(std::chrono::steady_clock::now() - start).count();
    return drawing;
}

} // namespace shadowbench::develop
