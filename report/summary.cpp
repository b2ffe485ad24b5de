#include "report/summary.h"

#include "techniques/catalog.h"

#include "report/cost_report.h"
#include "report/run_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <tuple>

namespace shadowbench::report {

bool dominates(const Place& a, const Place& b) {
    const bool cheaper = a.cost * (1 + a.costSpread) < b.cost * (1 - b.costSpread);
    const bool dearer = a.cost * (1 - a.costSpread) > b.cost * (1 + b.costSpread);
    return (a.error <= b.error && cheaper) || (a.error < b.error && !dearer);
}

bool isBaseline(const Record& record) { return record.technique == "none"; }

double spreadOf(std::vector<double> times) {
    if (times.empty()) return 0;
    std::ranges::sort(times);
    const double n = static_cast<double>(times.size());
    const auto low = static_cast<std::size_t>(std::max(0.0, std::floor(0.5 * n - 0.98 * std::sqrt(n)))); // 1.96 / 2
    const double median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
    return 0.5 * (times[times.size() - 1 - low] - times[low]) / median;
}

namespace {

std::optional<FrameCost> movingCost(const Record& record) {
    const std::optional<double>& ratio = record.values["cost.motion.time.ratio"];
    if (!ratio || isExternal(record)) return {};
    return FrameCost{*ratio, spreadOf(record.values.list("cost.motion.time.samples"))};
}

} // namespace

std::optional<FrameCost> standingCost(const Record& record) {
    const std::optional<double>& ratio = record.values["cost.time.ratio"];
    if (!ratio || isExternal(record)) return {};
    return FrameCost{*ratio, spreadOf(record.values.list("cost.time.samples"))};
}

std::optional<FrameCost> frameCost(const Record& record) {
    const std::optional<FrameCost> stands = standingCost(record), moves = movingCost(record);
    const bool dearer = stands && moves && moves->ratio * (1 - moves->spread) > stands->ratio * (1 + stands->spread);
    return dearer ? moves : stands;
}

bool knowsMotion(const Record& record) { return movingCost(record).has_value(); }

std::optional<double> cacheSaves(const Record& record) {
    const std::optional<FrameCost> stands = standingCost(record), moves = movingCost(record);
    if (!stands || !moves || changedPasses(record.motionPasses, record.passes).empty()) return {};
    return moves->ratio / stands->ratio;
}

std::vector<Record> standing(std::vector<Record> records) {
    for (Record& record : records) {
        for (const metrics::Metric& line : metrics::linesOf("cost.motion")) record.values.clear(line);
        record.motionPasses.clear();
        for (auto& [name, cost] : record.modelled) cost.motion.reset();
    }
    return records;
}

std::string costMeaning(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<std::size_t> all = ofScene(records, scene);
    const bool moves = std::ranges::any_of(all, [&](std::size_t i) { return knowsMotion(records[i]); });
    return moves ? "frames of sm-uniform, the dearer of standing and in motion" : "standing frames of sm-uniform";
}

std::vector<std::string> scenes(const std::vector<Record>& records) {
    std::vector<std::string> ids;
    for (const Record& record : records)
        if (std::find(ids.begin(), ids.end(), record.scene) == ids.end()) ids.push_back(record.scene);
    return ids;
}

std::vector<std::size_t> ofScene(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < records.size(); ++i)
        if (records[i].scene == scene) indices.push_back(i);
    return indices;
}

std::vector<std::size_t> scoredOf(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::size_t> scored = ofScene(records, scene);
    std::erase_if(scored, [&](std::size_t i) { return !headline(records[i]); });
    return scored;
}

std::optional<double> exactError(const Record& record) {
    const std::optional<Headline> error = headline(record);
    if (!error || error->metric != "rmse") return {};
    for (const auto* truth : {&record.reference, &record.softReference})
        if (*truth && (*truth)->area) return (*truth)->area->rmse;
    return {};
}

std::map<std::size_t, std::vector<std::size_t>> inseparable(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::size_t> known = scoredOf(records, scene);
    std::erase_if(known, [&](std::size_t i) { return !exactError(records[i]); });
    std::map<std::size_t, std::vector<std::size_t>> result;
    for (const std::size_t i : known)
        for (const std::size_t j : known) {
            const double sampled = *records[i].values["accuracy.rmse"] - *records[j].values["accuracy.rmse"];
            const double exact = *exactError(records[i]) - *exactError(records[j]);
            if (sampled * exact < 0) result[i].push_back(j);
        }
    return result;
}

std::string variantsOf(const std::vector<Record>& records, const std::vector<std::size_t>& indices) {
    std::vector<std::string_view> variants;
    for (const std::size_t i : indices) variants.push_back(records[i].variant);
    return fmt::format("{}", fmt::join(variants, ", "));
}

std::optional<Place> place(const Record& record, const CostOf& costOf) {
    const std::optional<Headline> error = headline(record);
    const std::optional<FrameCost> cost = costOf(record);
    if (!error || !cost) return {};
    return Place{error->value, cost->ratio, cost->spread};
}

namespace {

/// What a viewer refuses although few of all receivers are wrong: shadows that are not there, light that is not. One pixel
/// in twenty of a shadow, or of its edge, is about the jagged rim of a shadow map whose texels are as large as pixels; a
/// missing post or rail is more. Lit ground is wide: one pixel in fifty of it is already a shadow of its own.
const std::vector<Tolerance>& besideOf(const std::string& metric) {
    static const std::vector<Tolerance> ofLabels{{"leak", 0.05}, {"false_shadow", 0.02}, {"missing_edges", 0.05}};
    static const std::vector<Tolerance> ofVisibility{{"umbra_leak", 0.05}};
    static const std::vector<Tolerance> none;
    if (metric == "mismatch") return ofLabels;
    return metric == "rmse" || metric == "penumbra_rmse" ? ofVisibility : none;
}

/// Those of a scene that states none.
std::vector<Tolerance> usualTolerances(const std::string& headline) {
    if (headline == "mismatch") return {{"mismatch", 0.02}};
    return headline == "rmse" ? std::vector<Tolerance>{{"penumbra_rmse", 0.05}, {"rmse", 0.03}} : std::vector<Tolerance>{};
}

/// Those that the scene states, by metric.
std::vector<Tolerance> statedTolerances(const std::vector<Record>& records, const std::string& scene) {
    for (const std::size_t i : ofScene(records, scene)) {
        std::vector<Tolerance> stated;
        for (const auto& [metric, value] : records[i].tolerances) stated.push_back({metric, value});
        if (!stated.empty()) return stated;
    }
    return {};
}

} // namespace

std::vector<Tolerance> tolerances(const std::vector<Record>& records, const std::string& scene) {
    std::vector<Tolerance> result = statedTolerances(records, scene);
    if (result.empty()) result = usualTolerances(headlineMetric(records, scene));
    for (const Tolerance& own : std::vector(result))
        for (const Tolerance& beside : besideOf(own.metric))
            if (std::ranges::find(result, beside.metric, &Tolerance::metric) == result.end()) result.push_back(beside);
    return result;
}

std::optional<Tolerance> tolerance(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<Tolerance> stated = statedTolerances(records, scene);
    return stated.empty() ? std::nullopt : std::optional(stated.front());
}

std::optional<double> shareOfTolerance(const Record& record, const std::vector<Tolerance>& tolerances) {
    std::optional<double> largest;
    for (const Tolerance& limit : tolerances)
        if (const std::optional<double> error = metrics::bounded(record.values, limit.metric))
            largest = std::max(largest.value_or(0), *error / limit.value);
    return largest;
}

bool isWithin(const Record& record, const std::vector<Tolerance>& tolerances) {
    const std::optional<double> share = shareOfTolerance(record, tolerances);
    return headline(record) && share && *share <= 1;
}

std::string headlineMetric(const std::vector<Record>& records, const std::string& scene) {
    for (const std::size_t i : ofScene(records, scene))
        if (const std::optional<Headline> error = headline(records[i])) return error->metric;
    return "";
}

std::string meaning(const std::string& metric) {
    if (metric == "mismatch") return "mismatching pixels";
    if (metric == "rmse") return "rms error of visibility";
    return metric;
}

bool isShare(const std::string& metric) {
    const metrics::Metric* line = metrics::boundedMetric(metric);
    return line != nullptr && line->unit == "share";
}

std::string percent(double share) {
    const double value = 100 * share;
    if (value > 0 && value < 0.005) return "< 0.01 %";
    if (value >= 99.95) return fmt::format("{:.0f} %", value);
    return value >= 9.995 ? fmt::format("{:.1f} %", value) : fmt::format("{:.2f} %", value);
}

std::string formatValue(const std::string& metric, double value) {
    return isShare(metric) ? percent(value) : fmt::format("{:.4f}", value);
}

std::string errorText(const Record& record) {
    const Headline head = headline(record).value();
    std::string text = formatValue(head.metric, head.value);
    const metrics::Values& values = record.values;
    if (const auto& half = values["stability.seeds.interval"]) text += " ± " + formatValue(head.metric, *half);
    if (const auto& worst = values["views.worst"]) text += ", worst " + formatValue(head.metric, *worst);
    return text;
}

std::string formatBound(const Tolerance& limit) {
    return isShare(limit.metric) ? fmt::format("{:g} %", 100 * limit.value) : fmt::format("{:g}", limit.value);
}

std::string formatBounds(const std::vector<Tolerance>& limits) {
    std::vector<std::string> parts;
    for (const Tolerance& limit : limits) parts.push_back(limit.metric + " " + formatBound(limit));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string reportedCosts(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> parts;
    for (const std::size_t i : ofScene(records, scene)) {
        if (!records[i].external || !records[i].external->reported) continue;
        const ReportedCost& cost = *records[i].external->reported;
        const std::string device = cost.device.empty() ? "" : fmt::format(" ({})", cost.device);
        parts.push_back(fmt::format("{} {:.3g} ms{}", records[i].variant, cost.milliseconds, device));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string nameForPeople(const Record& record) {
    if (record.external && !record.external->title.empty()) return record.external->title;
    const auto all = techniques::catalog();
    const auto entry = std::ranges::find(all, record.technique, &techniques::Entry::id);
    if (entry == all.end()) return record.variant;
    const std::size_t colon = record.variant.find(':');
    return colon == std::string::npos ? entry->title
                                      : fmt::format("{} ({})", entry->title, record.variant.substr(colon + 1));
}

std::string imageSize(const Record& record) {
    if (record.width == record.height) return fmt::format("{}²", record.width);
    return fmt::format("{} × {}", record.width, record.height);
}

std::string markdownText(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (std::string_view("|*_<>`\\").find(letter) != std::string_view::npos) result += '\\';
        result += letter;
    }
    return result;
}

std::string truth(const ReferenceInfo& reference) {
    if (reference.oracle != "povray") {
        const std::string exact = "exact (" + reference.oracle + ")";
        return reference.sigma > 0 ? fmt::format("{}, σ {:.1g}", exact, reference.sigma) : exact;
    }
    return fmt::format("POV-Ray {} samples, σ {:.1g}", reference.samples, reference.sigma);
}

std::vector<std::size_t> paretoFront(const std::vector<Record>& records, const std::string& scene, const CostOf& costOf) {
    std::vector<std::pair<std::size_t, Place>> candidates;
    for (const std::size_t i : ofScene(records, scene))
        if (const std::optional<Place> here = place(records[i], costOf)) candidates.emplace_back(i, *here);
    std::ranges::stable_sort(candidates, {}, [](const auto& candidate) { return candidate.second.cost; });
    std::vector<std::size_t> front;
    for (const auto& [i, here] : candidates)
        if (std::ranges::none_of(candidates, [&](const auto& other) { return dominates(other.second, here); }))
            front.push_back(i);
    return front;
}

std::string frontMark(const std::vector<Record>& records, const std::string& scene, std::size_t index,
                      const CostOf& costOf) {
    const std::vector<std::size_t> front = paretoFront(records, scene, costOf);
    if (std::ranges::find(front, index) == front.end()) return "";
    if (isBaseline(records[index])) return "○";
    const std::vector<Tolerance> limits = tolerances(records, scene);
    const std::optional<double> share = shareOfTolerance(records[index], limits);
    return limits.empty() || (share && *share <= markedWithin) ? "●" : "○";
}

std::optional<std::size_t> keptOffFrontBy(const std::vector<Record>& records, const std::string& scene, std::size_t index,
                                          const CostOf& costOf) {
    const std::optional<Place> here = place(records[index], costOf);
    if (!here) return {};
    std::optional<std::size_t> by;
    for (const std::size_t i : ofScene(records, scene)) {
        const std::optional<Place> other = place(records[i], costOf);
        if (!other) continue;
        if (dominates({other->error, other->cost}, {here->error, here->cost})) return {};
        if (dominates(*other, *here)) by = i;
    }
    return by;
}

} // namespace shadowbench::report
