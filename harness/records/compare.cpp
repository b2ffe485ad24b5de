#include "harness/records/compare.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace shadowbench::gate {
namespace {

void requireOneEnvironment(const Record& base, const Record& head) {
    if (!base.values["cost.instructions"] || !head.values["cost.instructions"]) return;
    const std::string before = countingEnvironment(base.environment), now = countingEnvironment(head.environment);
    if (before == now) return;
    throw Inconclusive(fmt::format("instructions counted in different environments cannot be compared: base \"{}\", head "
                                   "\"{}\"; count both on one machine",
                                   before, now));
}

void requireOneTruth(const Record& base, const Record& head) {
    if (truthOf(base) == truthOf(head)) return;
    throw Inconclusive(fmt::format("{} on {} was scored against different truths: the scene or the ground truth changed, so "
                                   "the records cannot be compared; make the base's again",
                                   head.variant, head.scene));
}

std::string changed(const metrics::Metric& metric, const Record& record, double base, double head) {
    return fmt::format("{} on {}: {} {} → {}{}", record.variant, record.scene, metric.path, base, head,
                       base > 0 ? fmt::format(" ({:+.2f} %)", 100 * (head / base - 1)) : "");
}

/// One curve of a sweep: its values from harmless to hard and where on it the tolerance was first exceeded.
struct Curve {
    const Record* first = nullptr;
    std::vector<double> values;

    /// One past the last where nothing broke.
    [[nodiscard]] std::ptrdiff_t breakIndex() const {
        const auto& point = first->sweep->breakPoint;
        return (point ? std::ranges::find(values, *point) : values.end()) - values.begin();
    }
    [[nodiscard]] std::string breakText() const {
        const auto& point = first->sweep->breakPoint;
        return point ? fmt::format("breaks at {:g} {}", *point, first->sweep->unit) : "does not break";
    }
};

using Curves = std::map<std::tuple<std::string, std::string, std::string>, Curve>;

Curves curvesOf(const std::vector<Record>& records) {
    Curves curves;
    for (const Record& record : records) {
        if (!record.sweep) continue;
        Curve& curve = curves[{record.scene, record.sweep->axis, record.sweep->curve}];
        if (curve.first == nullptr) curve.first = &record;
        curve.values.push_back(record.sweep->value);
    }
    return curves;
}

void compareBreakPoints(const Curves& base, const Curves& head, std::vector<Change>& changes) {
    for (const auto& [key, curve] : head) {
        const auto found = base.find(key);
        if (found == base.end() || found->second.values != curve.values) continue; // other places: nothing to compare
        const std::ptrdiff_t was = found->second.breakIndex(), is = curve.breakIndex();
        const SweepStep& step = *curve.first->sweep;
        changes.push_back({curve.first->scene, step.curve, "sweep.break_point", Class::BreakPoint,
                           found->second.first->sweep->breakPoint, step.breakPoint, 0,
                           is < was   ? Direction::Worse
                           : is > was ? Direction::Better
                                      : Direction::Same,
                           fmt::format("{} on {} along {}: it {}, before it {}", step.curve, curve.first->scene, step.axis,
                                       curve.breakText(), found->second.breakText()),
                           step.axis});
    }
}

Change statusChange(const Record& record, Direction direction, const std::string& what) {
    return {record.scene,
            record.variant,
            "status",
            Class::Status,
            {},
            {},
            0,
            direction,
            fmt::format("{} on {} {}", record.variant, record.scene, what)};
}

bool scored(const Record& record) { return wasScored(record.status); }

void compareCells(const Record& base, const Record& head, std::vector<Change>& changes) {
    if (scored(base) != scored(head)) {
        const std::string what = fmt::format("was {} and is {}{}{}", name(base.status), name(head.status),
                                             head.reason.empty() ? "" : ": ", head.reason);
        changes.push_back(statusChange(head, scored(base) ? Direction::Worse : Direction::Better, what));
    }
    if (!scored(base) || !scored(head)) return;
    requireOneTruth(base, head);
    requireOneEnvironment(base, head);
    for (const metrics::Metric& metric : metrics::table) {
        const auto before = comparedValue(metric, base), now = comparedValue(metric, head);
        if (!before) continue;
        Change change{head.scene, head.variant, std::string(metric.path), *metric.about, before, now, 0, {}, {}};
        if (now) {
            change.allowance = allowanceOf(metric, base, *before);
            change.direction = directionOf(*before, *now, change.allowance);
            change.sentence = changed(metric, head, *before, *now);
        } else {
            change.direction = Direction::Worse;
            change.sentence = fmt::format("{} on {}: {} is no longer measured", head.variant, head.scene, metric.path);
        }
        changes.push_back(std::move(change));
    }
}

} // namespace

std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record) {
    const std::optional<double>& value = record.values[metric];
    if (!metric.allowance || !value) return {};
    return metric.allowance->magnitude ? std::abs(*value) : *value;
}

double allowanceOf(const metrics::Metric& metric, const Record& base, double value) {
    using metrics::TruthError;
    constexpr double twoPixels = 2; // whose centres lie on an edge: their labels are arbitrary
    const double all = static_cast<double>(base.width) * base.height;
    const ReferenceInfo none;
    const double sigma = (base.softReference ? base.softReference : base.reference).value_or(none).sigma;
    const metrics::Allowance& allowance = *metric.allowance;
    // An error e measured against a truth that is off by σ reads √(e² + σ²). An exact truth is off by stray pixels only.
    const double off = sigma > 0 ? sigma : allowance.truth == TruthError::Rms ? std::sqrt(twoPixels / all) : 0;
    double truth = allowance.truth == TruthError::None ? 0 : std::hypot(value, off) - value;
    if (allowance.truth == TruthError::Mean && sigma == 0) truth = twoPixels / all;
    return std::max({allowance.pixels / all, truth, allowance.absolute}) + allowance.relative * std::abs(value);
}

Direction directionOf(double base, double head, double allowance) {
    if (head > base + allowance) return Direction::Worse;
    return head < base - allowance ? Direction::Better : Direction::Same;
}

CellKey cellOf(const Record& r) {
    const SweepStep step = r.sweep.value_or(SweepStep{});
    return {r.scene, r.variant, r.profile, r.width, r.height, r.seed, step.axis, step.curve, step.value};
}

std::string countingEnvironment(const Environment& e) {
    return fmt::format("{}, {}, {} raster threads, {} bits, {}, {}", e.renderer, e.gl, e.rasterThreads, e.vectorBits,
                       e.valgrind.value_or("no Valgrind"), e.cpu);
}

std::string truthOf(const Record& record) {
    const auto key = [](const std::optional<ReferenceInfo>& reference) { return reference ? reference->key : ""; };
    return key(record.reference) + " " + key(record.softReference);
}

std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head) {
    std::map<CellKey, const Record*> before;
    for (const Record& record : base) before[cellOf(record)] = &record;
    std::vector<Change> changes;
    for (const Record& record : head) {
        const auto found = before.find(cellOf(record));
        if (found == before.end()) {
            changes.push_back(statusChange(record, Direction::Same, "is new"));
            continue;
        }
        compareCells(*found->second, record, changes);
        before.erase(found);
    }
    for (const Record& record : base)
        if (before.contains(cellOf(record)))
            changes.push_back(statusChange(record, Direction::Worse, "is no longer measured"));
    compareBreakPoints(curvesOf(base), curvesOf(head), changes);
    return changes;
}

} // namespace shadowbench::gate
