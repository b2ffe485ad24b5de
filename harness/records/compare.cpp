#include "harness/records/compare.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

namespace shadowbench::gate {
namespace {

/// A cell on both sides, once a seed; in the order of seeds.
struct Cell {
    std::vector<const Record*> base, head;

    /// Whether it holds for every seed.
    [[nodiscard]] bool is(bool (*predicate)(const Record&, const Record&)) const {
        return std::equal(base.begin(), base.end(), head.begin(),
                          [&](const Record* before, const Record* now) { return predicate(*before, *now); });
    }
};

bool scored(const Record& record) { return wasScored(record.status); }

bool isScore(const metrics::Metric& metric) {
    return metric.about != Class::Work && metric.about != Class::Instructions && metric.about != Class::Time;
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

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double squaresAround(const std::vector<double>& values, double centre) {
    double sum = 0;
    for (const double value : values) sum += (value - centre) * (value - centre);
    return sum;
}

/// By how much the means of two sets of seeds of one program may differ. Five standard errors: with eight seeds a side, one
/// comparison in ten thousand of equal programs exceeds it.
double spreadOf(const std::vector<double>& base, const std::vector<double>& head) {
    const auto n = static_cast<double>(base.size());
    if (n < 2) return 0;
    const double variance = (squaresAround(base, mean(base)) + squaresAround(head, mean(head))) / (2 * (n - 1));
    return 5 * std::sqrt(2 * variance / n);
}

/// One number of a cell, on both sides.
struct Compared {
    std::vector<double> base, head; // by seed

    [[nodiscard]] double before() const { return mean(base); }
    [[nodiscard]] double now() const { return mean(head); }
};

std::string sentenceOf(const Record& record, std::string_view what, const Compared& values) {
    const double before = values.before(), now = values.now();
    return fmt::format("{} on {}: {} {} → {}{}{}", record.variant, record.scene, what, before, now,
                       before > 0 ? fmt::format(" ({:+.2f} %)", 100 * (now / before - 1)) : "",
                       values.base.size() > 1 ? fmt::format(", means of {} seeds", values.base.size()) : "");
}

/// A sign that has turned is no improvement unless the number comes nearer to 0.
bool turned(const metrics::Metric& metric, const Cell& cell, const Change& change) {
    if (!metric.allowance->magnitude) return false;
    const double before = *cell.base.front()->values[metric], now = *cell.head.front()->values[metric];
    return before * now < 0 && std::abs(now) > change.allowance && std::abs(now) > std::abs(before) - change.allowance;
}

/// What the cells that both sides show alike say of metrics' code that differs.
class MetricCode {
public:
    explicit MetricCode(const std::vector<Cell>& cells) {
        for (const Cell& cell : cells)
            if (!cell.is(sameMetricCode) && cell.is(sameImages) && !whyIncomparable(*cell.base.front(), *cell.head.front()))
                take(*cell.base.front(), *cell.head.front());
    }

    [[nodiscard]] bool scoresAlike(const metrics::Metric& metric) const {
        return alike_.contains(metric.path) && !unlike_.contains(metric.path);
    }

private:
    void take(const Record& base, const Record& head) {
        for (const metrics::Metric& metric : metrics::table)
            if ((base.values[metric] || head.values[metric]) && !whyIncomparable(metric, base, head))
                (base.values[metric] == head.values[metric] ? alike_ : unlike_).insert(metric.path);
    }

    std::set<std::string_view> alike_, unlike_;
};

class Comparison {
public:
    Comparison(const std::vector<Cell>& cells, std::vector<Change>& changes) : code_(cells), changes_(changes) {}

    void compareCell(const Cell& cell) {
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        compareStatus(base, head);
        if (!scored(base) || !scored(head)) return;
        if (const auto why = whyIncomparable(base, head)) return unjudged(head, *why);
        for (const metrics::Metric& metric : metrics::table)
            if (metric.allowance) compareMetric(cell, metric);
        compareFigures(cell);
    }

private:
    void compareStatus(const Record& base, const Record& head) {
        if (scored(base) == scored(head)) return;
        const std::string what = fmt::format("was {} and is {}{}{}", name(base.status), name(head.status),
                                             head.reason.empty() ? "" : ": ", head.reason);
        changes_.push_back(statusChange(head, scored(base) ? Direction::Worse : Direction::Better, what));
    }

    void unjudged(const Record& record, const std::string& why) {
        changes_.push_back(statusChange(record, Direction::Unjudged, "cannot be compared: " + why));
    }

    void compareMetric(const Cell& cell, const metrics::Metric& metric) {
        Compared values;
        for (const Record* record : cell.base)
            if (const auto value = comparedValue(metric, *record)) values.base.push_back(*value);
        for (const Record* record : cell.head)
            if (const auto value = comparedValue(metric, *record)) values.head.push_back(*value);
        if (values.base.size() < cell.base.size()) return; // new to this cell
        const Record& head = *cell.head.front();
        Change change{head.scene, head.variant, std::string(metric.path), *metric.about, values.before(), {}, 0, {}, {}};
        if (values.head.size() < cell.head.size()) {
            change.direction = Direction::Worse;
            change.sentence = fmt::format("{} on {}: {} is no longer measured", head.variant, head.scene, metric.path);
            changes_.push_back(std::move(change));
            return;
        }
        change.head = values.now();
        change.allowance = allowanceOf(metric, *cell.base.front(), values.before()) + spreadOf(values.base, values.head);
        change.direction =
            turned(metric, cell, change) ? Direction::Worse : directionOf(values.before(), values.now(), change.allowance);
        change.sentence = sentenceOf(head, metric.path, values);
        if (const auto why = whyUnjudged(cell, metric, values)) {
            change.direction = Direction::Unjudged;
            change.sentence += ", which is not judged: " + *why;
        }
        changes_.push_back(std::move(change));
    }

    [[nodiscard]] std::optional<std::string> whyUnjudged(const Cell& cell, const metrics::Metric& metric,
                                                         const Compared& values) const {
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        if (metric.about == Class::Instructions)
            if (const auto differs = difference(base.environment, head.environment, Surroundings::OfCounts))
                return "counted in different environments, " + *differs + "; count both on one machine";
        if (!isScore(metric)) return {};
        if (auto why = whyIncomparable(metric, base, head)) return why;
        if (cell.is(sameMetricCode)) return {};
        if (cell.is(sameImages)) {
            if (values.base == values.head) return {};
            return "the images are the same, so the code of the metrics changed";
        }
        if (code_.scoresAlike(metric)) return {};
        return "the code of the metrics differs, and cells whose images are the same do not show that it scores alike";
    }

    /// Figures have no better direction. They explain a technique, so what changes them by more than a quarter is named.
    void compareFigures(const Cell& cell) {
        constexpr double relative = 0.25, absolute = 0.01;
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        for (const auto& [name, first] : base.figures) {
            const std::string path = "figures." + name;
            Change change{head.scene, head.variant, path, Class::Figure, first, {}, 0, Direction::Worse, {}};
            const auto now = head.figures.find(name);
            if (now == head.figures.end()) {
                change.sentence = fmt::format("{} on {}: {} is no longer reported", head.variant, head.scene, path);
            } else {
                change.head = now->second;
                change.allowance = relative * std::max(std::abs(first), std::abs(now->second)) + absolute;
                if (std::abs(now->second - first) <= change.allowance) change.direction = Direction::Same;
                change.sentence = sentenceOf(head, path, {{first}, {now->second}});
            }
            changes_.push_back(std::move(change));
        }
    }

    MetricCode code_;
    std::vector<Change>& changes_;
};

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
    /// The first one decides where a curve breaks.
    [[nodiscard]] std::string toleranceText() const {
        const auto& all = first->tolerances;
        return all.empty() ? "none" : fmt::format("{} ≤ {}", all.begin()->first, all.begin()->second);
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
        if (found == base.end() || found->second.values != curve.values) continue; // its cells are new, or gone
        const Curve& before = found->second;
        const std::ptrdiff_t was = before.breakIndex(), is = curve.breakIndex();
        const SweepStep& step = *curve.first->sweep;
        Change change{curve.first->scene,
                      step.curve,
                      "sweep.break_point",
                      Class::BreakPoint,
                      before.first->sweep->breakPoint,
                      step.breakPoint,
                      0,
                      Direction::Same,
                      fmt::format("{} on {} along {}: it {}, before it {}", step.curve, curve.first->scene, step.axis,
                                  curve.breakText(), before.breakText()),
                      step.axis};
        if (curve.toleranceText() != before.toleranceText()) {
            change.direction = Direction::Unjudged;
            change.sentence += fmt::format(", which is not judged: the scene's tolerance is {} and was {}",
                                           curve.toleranceText(), before.toleranceText());
        } else if (is != was) {
            change.direction = is < was ? Direction::Worse : Direction::Better;
        }
        changes.push_back(std::move(change));
    }
}

/// Without the seed.
using SeedlessKey = std::tuple<std::string, std::string, std::string, int, int, std::string, std::string, double>;
SeedlessKey withoutSeed(const CellKey& key) {
    const auto& [scene, variant, profile, width, height, seed, axis, curve, value] = key;
    return {scene, variant, profile, width, height, axis, curve, value};
}

/// The cells that both have, in the order of `head`; what only one has is a change of status.
std::vector<Cell> matched(const std::vector<Record>& base, const std::vector<Record>& head, std::vector<Change>& isNew,
                          std::vector<Change>& isGone) {
    std::map<CellKey, const Record*> before;
    for (const Record& record : base) before[cellOf(record)] = &record;
    std::vector<Cell> cells;
    std::map<SeedlessKey, std::size_t> places;
    for (const Record& record : head) {
        const auto found = before.find(cellOf(record));
        if (found == before.end()) {
            isNew.push_back(statusChange(record, Direction::Same, "is new"));
            continue;
        }
        const auto [place, first] = places.try_emplace(withoutSeed(found->first), cells.size());
        if (first) cells.emplace_back();
        cells[place->second].base.push_back(found->second);
        cells[place->second].head.push_back(&record);
        before.erase(found);
    }
    for (const Record& record : base)
        if (before.contains(cellOf(record)))
            isGone.push_back(statusChange(record, Direction::Worse, "is no longer measured"));
    return cells;
}

/// Commit, whether it had changes, and program, of all records; more than one where they were joined.
std::set<std::tuple<std::string, bool, std::string>> programsOf(const std::vector<Record>& records) {
    std::set<std::tuple<std::string, bool, std::string>> programs;
    for (const Record& record : records) programs.emplace(record.commit, record.dirty, record.program);
    return programs;
}

} // namespace

Direction directionOf(double base, double head, double allowance) {
    if (head > base + allowance) return Direction::Worse;
    return head < base - allowance ? Direction::Better : Direction::Same;
}

CellKey cellOf(const Record& r) {
    const SweepStep step = r.sweep.value_or(SweepStep{});
    return {r.scene, r.variant, r.profile, r.width, r.height, r.seed, step.axis, step.curve, step.value};
}

std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head) {
    std::vector<Change> changes, isGone;
    const std::vector<Cell> cells = matched(base, head, changes, isGone);
    Comparison comparison(cells, changes);
    for (const Cell& cell : cells) comparison.compareCell(cell);
    std::ranges::move(isGone, std::back_inserter(changes));
    compareBreakPoints(curvesOf(base), curvesOf(head), changes);
    return changes;
}

std::optional<std::string> whyMeaningless(const std::vector<Record>& base, const std::vector<Record>& head,
                                          bool sameProgramIsMeant) {
    const auto before = programsOf(base);
    const auto& [commit, dirty, program] = before.empty() ? std::tuple<std::string, bool, std::string>() : *before.begin();
    const bool ours = std::ranges::none_of(head, isExternal); // another renderer may have changed
    const bool known = !dirty || !program.empty();            // two trees with changes have one commit
    if (!sameProgramIsMeant && ours && known && before.size() == 1 && before == programsOf(head))
        return fmt::format(
            "both are records of one program, commit {}: compared with itself it is never worse; name records "
            "of another, or say --aa if that is meant",
            commit);
    std::set<CellKey> there;
    for (const Record& record : base)
        if (scored(record)) there.insert(cellOf(record));
    if (std::ranges::none_of(head, [&](const Record& r) { return scored(r) && there.contains(cellOf(r)); }))
        return "no cell is scored in both, so nothing is compared; measure the same scenes and techniques of both";
    return {};
}

bool sameProgram(const std::vector<Record>& base, const std::vector<Record>& head) {
    std::set<std::string> programs;
    for (const std::vector<Record>* records : {&base, &head})
        for (const Record& record : *records) programs.insert(record.program);
    return programs.size() == 1 && !programs.begin()->empty();
}

} // namespace shadowbench::gate
