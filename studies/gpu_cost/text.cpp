#include "report/text_table.h"
#include "studies/gpu_cost/gpu_cost.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace shadowbench::gpucost {
namespace {

std::string limitOf(const ModelledFrame& frame) {
    if (frame.waits) return "waits for the program";
    return fmt::format("{}: {}", frame.slowest().name, gpu::name(frame.slowest().terms.limit()));
}

std::string titleOf(const ModelledFrame& frame) {
    return fmt::format("{} at {}×{} on {}, modelled", frame.scene, frame.size.x, frame.size.y,
                       gpu::cardNamed(frame.card).name);
}

report::TextTable tableOf(const std::vector<const ModelledFrame*>& frames) {
    report::TextTable table{{"technique", "modelled ms", "from", "to", "limited by"}, {}};
    const bool anyMeasured =
        std::ranges::any_of(frames, [](const ModelledFrame* frame) { return frame->measured.has_value(); });
    if (anyMeasured) table.titles.emplace_back("measured ms");
    for (const ModelledFrame* frame : frames) {
        std::vector<std::string> row{frame->variant, fmt::format("{:.3f}", 1e3 * frame->time.seconds),
                                     fmt::format("{:.3f}", 1e3 * frame->time.least),
                                     fmt::format("{:.3f}", 1e3 * frame->time.most), limitOf(*frame)};
        if (anyMeasured) row.push_back(frame->measured ? fmt::format("{:.3f}", *frame->measured) : "–");
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

std::string tables(const std::vector<ModelledFrame>& frames) {
    std::vector<std::pair<std::string, std::vector<const ModelledFrame*>>> all; // in the order of first frames
    for (const ModelledFrame& frame : frames) {
        const std::string title = titleOf(frame);
        auto found = std::ranges::find(all, title, &decltype(all)::value_type::first);
        if (found == all.end()) found = all.insert(found, {title, {}});
        found->second.push_back(&frame);
    }
    std::string text;
    for (const auto& [title, ofTitle] : all) text += title + "\n" + report::aligned(tableOf(ofTitle)) + "\n";
    return text;
}

} // namespace shadowbench::gpucost
