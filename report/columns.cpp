#include "report/columns.h"

#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

std::string thousandths(double value) { return fmt::format("{:.2f}", 1000 * value); }

template <int places, int factor = 1>
std::string decimals(double value) {
    return fmt::format("{:.{}f}", value / factor, places);
}

std::optional<double> costOf(const Record& record) {
    const std::optional<FrameCost> cost = frameCost(record);
    return cost ? std::optional(cost->ratio) : std::nullopt;
}

} // namespace

std::span<const Column> columns() {
    static constexpr Column all[] = {
        {"false shadow", false, "accuracy.false_shadow", percent},
        {"leak", false, "accuracy.leak", percent},
        {"edge error px", false, "accuracy.edge_error.mean", decimals<2>},
        {"median", true, "accuracy.edge_error.median", decimals<2>},
        {"missing edges", true, "accuracy.edge_error.missing", percent},
        {"islands", true, "accuracy.edge_error.islands", decimals<0>},
        {"off-edge error", true, "accuracy.mismatch_off_edge", percent},
        {"bad30", true, "accuracy.bad30", percent},
        {"SSIM", true, "accuracy.ssim", decimals<3>},
        {"area rmse", true, "accuracy.pixel_area.rmse", decimals<4>},
        {"area bad30", true, "accuracy.pixel_area.bad30", percent},
        {"area SSIM", true, "accuracy.pixel_area.ssim", decimals<3>},
        {"penumbra rmse", true, "accuracy.penumbra_rmse", decimals<4>},
        {"dilated", true, "accuracy.penumbra_rmse_dilated", decimals<4>},
        {"penumbra width", true, "accuracy.penumbra_width_error", percent},
        {"umbra leak", true, "accuracy.umbra_leak", decimals<4>},
        {"FLIP", true, "accuracy.flip", decimals<4>},
        {"texel px", true, "aliasing.median", decimals<2>},
        {"texel px p95", true, "aliasing.p95", decimals<2>},
        {"flicker", false, "stability.flicker.mean", decimals<4>},
        {"floor", true, "stability.flicker.floor", decimals<4>},
        {"flicker/°", true, "stability.flicker.per_degree", decimals<4>},
        {"flips", true, "stability.flip_rate", percent},
        {"moving rmse", true, "stability.moving_rmse", decimals<4>},
        {"ghost half-life", true, "stability.ghost_half_life", decimals<1>},
        {"seeds: bias", true, "stability.seeds.bias", decimals<4>},
        {"systematic", true, "stability.seeds.systematic", decimals<4>},
        {"noise", true, "stability.seeds.noise", decimals<4>},
        {"converged at", true, "stability.convergence", decimals<0>},
        {"MiB", true, "cost.work.bytes", decimals<1, 1 << 20>},
        {"peak MiB", true, "cost.work.peak_bytes", decimals<1, 1 << 20>},
        {"ms", true, "cost.time.median", decimals<2>},
        {"processor", true, "cost.time.processor", percent},
        {"first frame ms", true, "cost.cold.time", decimals<2>},
        {"compiling ms", true, "cost.cold.compile", decimals<0>},
        {"standing", true, "cost.time.ratio", decimals<2>},
        {"in motion", true, "cost.motion.time.ratio", decimals<2>},
        {"moving / standing", true, "cost.motion.time.ratio", decimals<2>, cacheSaves, "cache",
         "the frame in motion as a multiple of the standing one, where it draws more"},
        {"cost", false, "cost.time.ratio", decimals<2>, costOf, "cost",
         "time of a frame as a multiple of sm-uniform's: the dearer of the standing one and the one in motion"},
    };
    return all;
}

std::span<const Column> lodColumns() {
    static constexpr Column all[] = {
        {"pop", false, "lod.pop", thousandths},
        {"region px", false, "lod.changed_region", decimals<0>},
        {"walk pop", true, "lod.walk_pop", thousandths},
        {"colour error", false, "lod.colour_error", decimals<4>},
        {"noise", false, "lod.noise", decimals<4>},
        {"order error", false, "lod.order_error", decimals<4>},
        {"primitives", false, "lod.primitives", decimals<0>},
        {"change", false, "lod.primitive_change", percent},
        {"MiB", true, "cost.work.bytes", decimals<1, 1 << 20>},
        {"ms", true, "lod.time.median", decimals<2>},
        {"spread", true, "lod.time.spread", percent},
        {"cost", false, "lod.time.ratio", decimals<2>},
    };
    return all;
}

std::vector<const Column*> applying(std::span<const Column> columns, const std::vector<const Record*>& records) {
    std::vector<const Column*> found;
    for (const Column& column : columns)
        if (std::ranges::any_of(records, [&](const Record* record) { return column.of(*record).has_value(); }))
            found.push_back(&column);
    return found;
}

void addColumns(TextTable& table, std::span<const Column> columns, const std::vector<const Record*>& records, bool page) {
    for (const Column* column : applying(columns, records)) {
        if (column->pageOnly && !page) continue;
        table.titles.emplace_back(column->title);
        for (std::size_t row = 0; row < records.size(); ++row) {
            const std::optional<double> value = column->of(*records[row]);
            table.rows[row].push_back(value ? column->format(*value) : "–");
        }
    }
}

} // namespace shadowbench::report
