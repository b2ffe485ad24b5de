// The documents' curves over frames, drawn again from records.
#include "report/charts.h"
#include "studies/papers/papers.h"

#include <algorithm>

namespace shadowbench {
namespace {

/// The variant's curve on the scene with the most frames: a sweep over still frames has longer ones than a run.
report::FramesCurve curveOf(const std::string& variant, const std::string& scene, const std::vector<Record>& records) {
    report::FramesCurve curve{variant, {}};
    for (const Record& record : records) {
        const std::string& name = record.sweep ? record.sweep->curve : record.variant;
        const bool sameFrames = !record.sweep || record.sweep->axis == "still-frames";
        if (record.scene != scene || name != variant || !sameFrames) continue;
        const std::vector<double>& frames = record.values.list("stability.by_frame.rmse");
        if (frames.size() > curve.values.size()) curve.values = frames;
        if (curve.values.empty() && record.values["accuracy.rmse"]) curve.values = {*record.values["accuracy.rmse"]};
    }
    return curve;
}

} // namespace

std::optional<std::string> paperChart(const PaperChart& chart, const std::vector<Record>& records) {
    std::vector<report::FramesCurve> curves;
    for (const std::string& variant : chart.variants)
        if (report::FramesCurve curve = curveOf(variant, chart.scene, records); !curve.values.empty())
            curves.push_back(std::move(curve));
    return report::framesChart(chart.scene + ": " + chart.title, "root mean square of V − V*", curves);
}

} // namespace shadowbench
