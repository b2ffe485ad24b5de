// Tables of level-of-detail techniques.
#include "report/columns.h"
#include "report/cost_report.h"
#include "report/lod_report.h"
#include "report/summary.h"

#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr const char* lodLegend = R"(
| column | meaning |
|:---|:---|
| pop | largest mean change of colour from one frame to the next, in 1/1000 of full colour, while the camera stands and levels alone change |
| region px | the same: pixels of the largest connected region that changes by more than 30/255 |
| walk pop | largest mean change of colour along the walk beyond that of `lod-full`; coarse levels alias less and change less |
| colour error | rms difference from `lod-full` |
| noise | mean distance from the 3 × 3 median beyond `lod-full`'s, over pixels that see a transition |
| order error | rms difference from the same with all triangles drawn the other way round |
| primitives, change | a frame, mean; largest change from one frame to the next |
| MiB | textures and buffers of the technique's own |
| ms, spread | frame time; its median change from one frame to the next |
| cost | frame time as a multiple of `lod-switch` |
)";

std::vector<const Record*> lodRecords(const std::vector<Record>& records, const std::string& scene) {
    std::vector<const Record*> result;
    for (const std::size_t i : ofScene(records, scene))
        if (isLevelOfDetail(records[i]) && !records[i].sweep) result.push_back(&records[i]);
    return result;
}

TextTable table(const std::vector<const Record*>& scored, bool page) {
    TextTable result{{"technique"}, {}};
    for (const Record* record : scored) result.rows.push_back({record->variant});
    addColumns(result, lodColumns(), scored, page);
    return result;
}

std::string noteOf(const std::vector<Record>& records, const std::string& scene) {
    const std::string note = rasteriserNote(records, scene);
    return note.empty() ? "" : "\n" + note + "\n";
}

std::string heading(const Record& record) {
    return fmt::format("{} · {} · {} frames, up to {:.0f} instances in transition", record.scene, imageSize(record),
                       record.frames, *record.values["lod.transitions"]);
}

} // namespace

std::string lodTerminalTable(const std::vector<Record>& records, const std::string& scene) {
    const auto scored = lodRecords(records, scene);
    if (scored.empty()) return "";
    return fmt::format(" levels of detail: {} · pop in 1/1000 · cost = frames of lod-switch\n", heading(*scored.front())) +
           aligned(table(scored, false));
}

TextTable lodTable(const std::vector<Record>& records, const std::string& scene) {
    return table(lodRecords(records, scene), true);
}

std::string lodMarkdownTable(const std::vector<Record>& records, const std::string& scene) {
    const auto scored = lodRecords(records, scene);
    if (scored.empty()) return "";
    return fmt::format("Walk: {}.\n\n", markdownText(heading(*scored.front()))) + markdown(table(scored, true)) + lodLegend +
           noteOf(records, scene);
}

} // namespace shadowbench::report
