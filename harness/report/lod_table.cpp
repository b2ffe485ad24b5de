// Tables of level-of-detail techniques.
#include "harness/report/lod_report.h"
#include "harness/report/summary.h"
#include "harness/report/text_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace shadowbench::report {
namespace {

constexpr const char* legend = R"(
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

using Cell = std::optional<std::string>;

struct Column {
    const char* title;
    bool pageOnly; // the terminal has no room for it
    Cell (*cell)(const Record&);
};

Cell time(const Record& r, double LodTime::*member, int places) {
    return r.lod->time ? Cell(fmt::format("{:.{}f}", *r.lod->time.*member, places)) : Cell();
}

Cell mebibytes(const Record& r) {
    if (!r.cost.work) return {};
    return fmt::format("{:.1f}", static_cast<double>(r.cost.work->bytes) / (1024.0 * 1024.0));
}

std::span<const Column> columns() {
    static constexpr Column all[] = {
        {"pop", false, [](const Record& r) { return Cell(fmt::format("{:.2f}", 1000 * r.lod->pop)); }},
        {"region px", false, [](const Record& r) { return Cell(std::to_string(r.lod->changedRegion)); }},
        {"walk pop", true, [](const Record& r) { return Cell(fmt::format("{:.2f}", 1000 * r.lod->walkPop)); }},
        {"colour error", false, [](const Record& r) { return Cell(fmt::format("{:.4f}", r.lod->colourError)); }},
        {"noise", false, [](const Record& r) { return r.lod->noise ? Cell(fmt::format("{:.4f}", *r.lod->noise)) : Cell(); }},
        {"order error", false, [](const Record& r) { return Cell(fmt::format("{:.4f}", r.lod->orderError)); }},
        {"primitives", false, [](const Record& r) { return Cell(fmt::format("{:.0f}", r.lod->primitives)); }},
        {"change", false, [](const Record& r) { return Cell(percent(r.lod->primitiveChange)); }},
        {"MiB", true, mebibytes},
        {"ms", true, [](const Record& r) { return time(r, &LodTime::median, 2); }},
        {"spread", true, [](const Record& r) { return r.lod->time ? Cell(percent(r.lod->time->spread)) : Cell(); }},
        {"cost", false, [](const Record& r) { return time(r, &LodTime::ratio, 2); }},
    };
    return all;
}

std::vector<const Record*> lodRecords(const std::vector<Record>& records, const std::string& scene) {
    std::vector<const Record*> result;
    for (const std::size_t i : ofScene(records, scene))
        if (records[i].lod && !records[i].sweep) result.push_back(&records[i]);
    return result;
}

TextTable table(const std::vector<const Record*>& scored, bool page) {
    TextTable result{{"technique"}, {}};
    for (const Record* record : scored) result.rows.push_back({record->variant});
    for (const Column& column : columns()) {
        if (column.pageOnly && !page) continue;
        if (std::ranges::none_of(scored, [&](const Record* r) { return column.cell(*r).has_value(); })) continue;
        result.titles.emplace_back(column.title);
        for (std::size_t row = 0; row < scored.size(); ++row)
            result.rows[row].push_back(column.cell(*scored[row]).value_or("–"));
    }
    return result;
}

std::string heading(const Record& record) {
    return fmt::format("{} · {} · {} frames, up to {} instances in transition", record.scene, imageSize(record),
                       record.frames, record.lod->transitions);
}

} // namespace

std::string lodTerminalTable(const std::vector<Record>& records, const std::string& scene) {
    const auto scored = lodRecords(records, scene);
    if (scored.empty()) return "";
    return fmt::format(" levels of detail: {} · pop in 1/1000 · cost = frames of lod-switch\n", heading(*scored.front())) +
           aligned(table(scored, false));
}

std::string lodMarkdownTable(const std::vector<Record>& records, const std::string& scene) {
    const auto scored = lodRecords(records, scene);
    if (scored.empty()) return "";
    return fmt::format("Walk: {}.\n\n", markdownText(heading(*scored.front()))) + markdown(table(scored, true)) + legend;
}

} // namespace shadowbench::report
