// The records as Markdown for where no browser is: report.md, with results.csv and the charts.
#include "base/files.h"
#include "harness/cells/cell_images.h"
#include "report/charts.h"
#include "report/cost_report.h"
#include "report/costing.h"
#include "report/lod_report.h"
#include "report/modelled_costs.h"
#include "report/run_report.h"
#include "report/run_text.h"
#include "report/slug.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr const char* columnLegend = R"(## The columns

| column | meaning |
|:---|:---|
| error | share of receiver pixels with the wrong label (per cent), or, on scenes lit by an area light, root mean square error of visibility |
| exact | on scenes lit by an area light: the error against the exact visible share of the light, which the error samples. Two rows that the two put in another order cannot be told apart |
| false shadow, leak | share of lit pixels called shadowed, share of shadowed pixels called lit |
| edge error px | mean displacement in pixels of the technique's shadow edge from the exact one, both ways |
| penumbra rmse, umbra leak | under an area light: error within the penumbra; mean visibility where the light is fully hidden |
| flicker | mean change between moving frames beyond that of the true pixel areas |
| cost | time of a frame as a multiple of `sm-uniform`'s: the dearer of standing and in motion; where motion was not measured, or is told not to be there (`--static`), standing |
| modelled ms | milliseconds of a frame on the graphics card that costs.md names first, modelled and not measured (docs/gpu-cost.md): the dearer of standing and in motion; – waits for the program |
| front | ● no other technique has both less error and less cost, modelled where it is and else measured, beyond the intervals of the costs; ○ the same for a baseline or an error of more than 10 times the tolerance |

– does not apply. Pixels count where the rasteriser and the truth see the same receiver. Every other figure of a row is in
results.csv and on the scene's page (index.html); docs/metrics.md says what each means.
)";

const std::string costPageHead = R"(# Costs, pass by pass

A frame is the G-buffer and the technique's passes; a pass that ran several times is one row. Between passes nothing is drawn.
Below a technique's standing frame stand the passes that are others in motion and in the first frame (wall time).
What grows with the screen has fragments in proportion to the pixels of the image; what grows with the map has as many on an
image of any size.
)";

std::string sceneSection(const std::vector<Record>& records, const std::string& scene,
                         const std::vector<std::string>& charts) {
    const Record& first = records[ofScene(records, scene).front()];
    const std::string metric = headlineMetric(records, scene);
    std::string text = fmt::format("## {}\n\n{} pixels, {} frames", markdownText(scene), imageSize(first), first.frames);
    if (!metric.empty()) text += ", error = " + meaning(metric);
    const std::string how = sceneTruth(records, scene);
    text += how.empty() ? ".\n\n" : fmt::format(". Truth: {}.\n\n", markdownText(how));
    text += markdownTable(records, scene) + "\n";
    for (const std::string& chart : charts) text += fmt::format("![{}]({})\n\n", chart.substr(0, chart.find('.')), chart);
    return text;
}

/// The pictures that `run --images` has left in the folder: the scene in mid-walk, and one instance's transition by
/// technique.
std::string lodPictures(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& folder) {
    std::string frame, rows;
    for (const std::size_t i : ofScene(records, scene)) {
        const std::string place = "images/" + scene + "/" + fileName(records[i].variant) + "/";
        std::error_code ignored; // a name may be too long for a file
        if (!isLevelOfDetail(records[i]) || !std::filesystem::exists(folder / (place + "transition.png"), ignored)) continue;
        if (frame.empty()) frame = fmt::format("![{}]({}frame.png)\n\n", markdownText(scene), place);
        rows += fmt::format("| {} | ![transition]({}transition.png) |\n", records[i].variant, place);
    }
    return rows.empty() ? "" : frame + "| technique | one instance through its transition |\n|:---|:---|\n" + rows + "\n";
}

constexpr const char* modelledNote =
    "Nothing was drawn on these cards: milliseconds of a standing frame are modelled (docs/gpu-cost.md). Places are among "
    "the "
    "rows that have all these costs, from the cheapest on. Limited by: the technique's "
    "longest pass, and what takes longest in it. × bound: the technique's passes as a multiple of what they would take "
    "without arithmetic.\n";

constexpr const char* deviceNote =
    "Frames are the G-buffer and the technique; × base: as a multiple of sm-uniform's, of levels of detail lod-switch's. "
    "The "
    "program's is its own time in passes that draw nothing; it is in a frame as far as the graphics processor waits for it "
    "(docs/devices.md). Passes below are of the first size.\n";

/// costs.md; "" where no record has passes with times.
std::string costPage(const std::vector<Record>& records) {
    std::string text;
    for (const std::string& scene : scenes(records)) {
        const std::string table = passTable(records, scene);
        if (table.empty()) continue;
        const Record& first = records[ofScene(records, scene).front()];
        const std::string frames = deviceTable(records, scene);
        text += fmt::format("\n## {}\n\n", markdownText(scene));
        if (frames.empty()) text += imageSize(first) + " pixels. ";
        text += rasteriserNote(records, scene) + "\n\n";
        if (!frames.empty()) text += fmt::format("{}\n{}\n", deviceNote, frames);
        text += table;
        if (const std::string modelled = modelledTable(records, scene); !modelled.empty())
            text += fmt::format("\n### Modelled on graphics cards\n\n{}\n{}", modelledNote, modelled);
    }
    return text.empty() ? "" : costPageHead + text;
}

std::string head(const std::vector<Record>& records) {
    std::string text = "# Shadow techniques against the truth\n\n";
    if (records.empty()) return text + "No records.\n";
    text += fmt::format("Commit {}. Measured on {}. Made again by:\n\n```\n{}\n```\n\n", commitsOf(records),
                        markdownText(environmentsOf(records)), runCommand(records));
    return text;
}

} // namespace

Written writeReport(const std::vector<Record>& records, const std::filesystem::path& folder,
                    const std::vector<std::string>& named) {
    Written written{folder / "report.md", {}};
    std::string page = head(records);
    for (const std::string& scene : scenes(records)) {
        std::vector<std::string> charts;
        const auto keep = [&](const std::string& kind, const std::optional<std::string>& svg) {
            if (!svg) return;
            charts.push_back(kind + "-" + slug(scene) + ".svg");
            writeFile(folder / charts.back(), *svg);
            written.charts.push_back(folder / charts.back());
        };
        for (const std::string& on : modelledNames(records, scene))
            keep(chartName(modelledOn(on)), modelledChart(records, scene, on, named));
        keep("pareto", paretoChart(records, scene, named));
        keep("convergence", convergenceChart(records, scene));
        keep("passes", passChart(records, scene));
        page += sceneSection(records, scene, charts);
        const std::string lod = lodMarkdownTable(records, scene);
        if (lod.empty()) continue;
        page += fmt::format("### Levels of detail: {}\n\n{}\n", markdownText(scene), lod);
        charts.clear();
        keep("lod", lodChart(records, scene));
        for (const std::string& chart : charts) page += fmt::format("![levels of detail]({})\n\n", chart);
        page += lodPictures(records, scene, folder);
    }
    if (const std::string costs = costPage(records); !costs.empty()) {
        writeFile(folder / "costs.md", costs);
        page += "Costs pass by pass: [costs.md](costs.md).\n\n";
    }
    if (const std::string passes = passCsv(records); !passes.empty()) writeFile(folder / "passes.csv", passes);
    writeFile(folder / "results.csv", csv(records));
    writeFile(written.page, page + columnLegend);
    return written;
}

} // namespace shadowbench::report
