// The cost of level-of-detail techniques over the size of the picture, as table and chart (dissertation Fig. 5.8).
#include "report/gnuplot.h"
#include "report/lod_report.h"
#include "report/summary.h"
#include "report/text_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr int width = 960, plotHeight = 460; // pixels
constexpr double top = 60, bottomMargin = 62;

struct Curve {
    std::string name;
    std::vector<const Record*> records; // by size
};

std::vector<Curve> curvesOf(const std::vector<Record>& records) {
    std::vector<Curve> curves;
    for (const Record& record : records) {
        auto curve = std::ranges::find(curves, record.sweep->curve, &Curve::name);
        if (curve == curves.end()) curve = curves.insert(curves.end(), {record.sweep->curve, {}});
        curve->records.push_back(&record);
    }
    return curves;
}

template <typename Cell>
std::string table(const std::vector<Curve>& curves, const char* title, const Cell& cell) {
    TextTable result{{title}, {}};
    for (const Record* record : curves.front().records) result.titles.push_back(fmt::format("{:g}²", record->sweep->value));
    for (const Curve& curve : curves) {
        std::vector<std::string>& row = result.rows.emplace_back(1, curve.name);
        for (const Record* record : curve.records) row.push_back(cell(*record));
    }
    return markdown(result);
}

} // namespace

std::string viewportTable(const std::vector<Record>& records) {
    const std::vector<Curve> curves = curvesOf(records);
    return fmt::format(
        "{}\n{}\n{}\n{}",
        table(curves, "ms a frame", [](const Record& r) { return fmt::format("{:.2f}", *r.values["lod.time.median"]); }),
        table(curves, "× lod-switch", [](const Record& r) { return fmt::format("{:.2f}", *r.values["lod.time.ratio"]); }),
        table(curves, "primitives", [](const Record& r) { return fmt::format("{:.0f}", *r.values["lod.primitives"]); }),
        table(curves, "fragments", [](const Record& r) { return fmt::format("{:.0f}", *r.values["cost.work.fragments"]); }));
}

std::string viewportChart(const std::vector<Record>& records) {
    const std::vector<Curve> curves = curvesOf(records);
    std::vector<std::string> names;
    std::vector<double> sizes, times;
    for (const Curve& curve : curves) {
        names.push_back(curve.name);
        for (const Record* record : curve.records) {
            sizes.push_back(record->sweep->value);
            times.push_back(*record->values["lod.time.median"]);
        }
    }
    const Legend legend{names, plotHeight};
    const double height = legend.bottom();
    std::string script =
        heading(fmt::format("{} ({}): frame time over the viewport", records.front().scene, records.front().profile),
                legend.bottom()) +
        legend.script() + "set xlabel 'side of the viewport [pixels]'\n" + LogAxis(sizes).script("x", 1, "") +
        "set ylabel 'frame time [ms]'\n" + LogAxis(times).script("y", 1, "");
    script += plotArea(0.085, 0.98, top, plotHeight - bottomMargin, height);
    std::string plots;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        script += fmt::format("$curve{} << EOD\n", i);
        for (const Record* record : curves[i].records)
            script += fmt::format("{} {}\n", record->sweep->value, *record->values["lod.time.median"]);
        script += "EOD\n";
        plots += fmt::format("{}$curve{} with linespoints pt 7 ps 0.4 {} notitle", i == 0 ? "plot " : ", ", i, lineStyle(i));
    }
    return svgOf(script + plots + "\n", width, legend.bottom());
}

} // namespace shadowbench::report
