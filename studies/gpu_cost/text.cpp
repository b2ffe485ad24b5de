#include "report/text_table.h"
#include "studies/gpu_cost/gpu_cost.h"

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

} // namespace

std::string tables(const std::vector<ModelledFrame>& frames) {
    std::vector<std::pair<std::string, report::TextTable>> all; // in the order of first frames
    for (const ModelledFrame& frame : frames) {
        const std::string title = titleOf(frame);
        auto found = all.begin();
        while (found != all.end() && found->first != title) ++found;
        if (found == all.end()) {
            report::TextTable table{{"technique", "modelled ms", "from", "to", "limited by"}, {}};
            if (frame.measured) table.titles.emplace_back("measured ms");
            found = all.insert(found, {title, table});
        }
        std::vector<std::string> row{frame.variant, fmt::format("{:.3f}", 1e3 * frame.time.seconds),
                                     fmt::format("{:.3f}", 1e3 * frame.time.least),
                                     fmt::format("{:.3f}", 1e3 * frame.time.most), limitOf(frame)};
        if (frame.measured) row.push_back(fmt::format("{:.3f}", *frame.measured));
        found->second.rows.push_back(std::move(row));
    }
    std::string text;
    for (const auto& [title, table] : all) text += title + "\n" + report::aligned(table) + "\n";
    return text;
}

} // namespace shadowbench::gpucost
