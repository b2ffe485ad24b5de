#include "harness/records/compare.h"

#include "harness/records/metric_code.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numeric>
#include <set>

namespace shadowbench::gate {
namespace {

bool scored(const Record& record) { return wasScored(record.status); }

Change statusChange(const std::string& scene, const std::string& variant, Direction direction, const std::string& what) {
    return {scene, variant, "status", Class::Status, {}, {}, 0, direction, fmt::format("{} on {} {}", variant, scene, what)};
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double squaresAroundMean(const std::vector<double>& values) {
    const double centre = mean(values);
    double sum = 0;
    for (const double value : values) sum += (value - centre) * (value - centre);
    return sum;
}

double deviation(const std::vector<double>& values) {
    return std::sqrt(squaresAroundMean(values) / static_cast<double>(values.size() - 1));
}

/// One number of a cell, on both sides.
struct Compared {
    std::vector<double> base, head; // by seed

    [[nodiscard]] double before() const { return mean(base); }
    [[nodiscard]] double now() const { return mean(head); }

    /// By how much the means of two sets of seeds of one program may differ.
    [[nodiscard]] double meansMayDiffer(const Rules& rules) const {
        const auto n = static_cast<double>(base.size());
        if (n < 2) return 0;
        const double variance = (squaresAroundMean(base) + squaresAroundMean(head)) / (2 * (n - 1));
        return rules.seedErrors * std::sqrt(2 * variance / n);
    }

    /// Whether the head's seeds scatter far more than the base's: then its mean says little.
    [[nodiscard]] bool scatters(const Rules& rules, double allowance) const {
        return base.size() > 1 && deviation(head) > rules.seedSpread * deviation(base) + std::abs(before()) + allowance;
    }
};

/// Two numbers in as many digits as show that they differ, three at least.
std::pair<std::string, std::string> digits(double a, double b) {
    for (int count = 3;; ++count) {
        const std::string first = fmt::format("{:.{}g}", a, count), second = fmt::format("{:.{}g}", b, count);
        if (a == b || first != second || count == 17) return {first, second};
    }
}

/// " (+12 %)", or as a factor where per cent would be thousands; nothing where there is no share of it.
std::string shareText(double before, double now) {
    if (before <= 0) return "";
    const double ratio = now / before;
    return ratio < 10 ? fmt::format(" ({:+.3g} %)", 100 * (ratio - 1)) : fmt::format(" (× {:.3g})", ratio);
}

std::string sentenceOf(const Record& record, std::string_view what, const Compared& values) {
    const double before = values.before(), now = values.now();
    const auto [first, second] = digits(before, now);
    return fmt::format("{} on {}: {} {} → {}{}{}", record.variant, record.scene, what, first, second, shareText(before, now),
                       values.base.size() > 1 ? fmt::format(", means of {} seeds", values.base.size()) : "");
}

/// The metric itself, not what is compared of it; a seed that lacks it counts as 0.
std::vector<double> recorded(const metrics::Metric& metric, const std::vector<const Record*>& records) {
    std::vector<double> values;
    for (const Record* record : records) values.push_back(record->values[metric].value_or(0));
    return values;
}

/// A sign that has turned is no improvement unless the number comes nearer to 0.
bool turned(const metrics::Metric& metric, const MatchedCell& cell, const Change& change) {
    const double before = mean(recorded(metric, cell.base)), now = mean(recorded(metric, cell.head));
    return before * now < 0 && std::abs(now) > change.allowance && std::abs(now) > std::abs(before) - change.allowance;
}

/// Which passes of a technique folder draw with something else than before, to follow what is another score.
std::string changedPasses(const Record& base, const Record& head) {
    std::vector<std::string> names;
    for (const PassRecord& pass : head.passes) {
        if (pass.drawnWith.empty()) continue;
        const auto before = std::ranges::find(base.passes, pass.name, &PassRecord::name);
        if (before == base.passes.end() || before->drawnWith != pass.drawnWith) names.push_back(pass.name);
    }
    return names.empty() ? "" : fmt::format("; the pass {} was changed", fmt::join(names, ", "));
}

class CellComparison {
public:
    CellComparison(const std::vector<MatchedCell>& cells, const Rules& rules, std::vector<Change>& changes)
        : rules_(rules), changes_(changes) {
        for (const MatchedCell& cell : cells)
            if (cell.is(sameImages)) code_.take(*cell.base.front(), *cell.head.front());
    }

    void compareCell(const MatchedCell& cell) {
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        if (const auto why = whyIncomparable(base, head)) {
            changes_.push_back(
                statusChange(head.scene, head.variant, Direction::NotCompared, "cannot be compared: " + *why));
            return;
        }
        for (const metrics::Metric& metric : metrics::table)
            if (metric.about && rules_.limits.contains(metric.path)) compareMetric(cell, metric);
        compareFigures(cell);
    }

private:
    [[nodiscard]] std::vector<double> valuesOf(const metrics::Metric& metric,
                                               const std::vector<const Record*>& records) const {
        std::vector<double> values;
        for (const Record* record : records)
            if (const auto value = comparedValue(metric, *record, rules_)) values.push_back(*value);
        return values;
    }

    void compareMetric(const MatchedCell& cell, const metrics::Metric& metric) {
        const Compared values{valuesOf(metric, cell.base), valuesOf(metric, cell.head)};
        const auto has = [&](const Record* record) { return record->values[metric].has_value(); };
        if (values.base.empty()) return;                                                          // new to this cell
        if (std::ranges::none_of(cell.base, has) && std::ranges::none_of(cell.head, has)) return; // best on both sides
        const Record& head = *cell.head.front();
        Change change{head.scene, head.variant, std::string(metric.path), *metric.about, values.before(), {}, 0, {}, {}};
        const bool isCounted = metric.about == Class::Instructions; // with one seed, whatever chance decides
        const bool wasWhole = isCounted || values.base.size() == cell.base.size();
        if (!wasWhole || values.head.size() < (isCounted ? values.base.size() : cell.head.size())) {
            change.direction = Direction::NotCompared;
            change.sentence = fmt::format("{} on {}: {} {}", head.variant, head.scene, metric.path,
                                          wasWhole ? "is no longer measured" : "was not measured with every seed");
        } else {
            judge(cell, metric, values, change);
        }
        if (change.direction != Direction::Same) change.sentence += changedPasses(*cell.base.front(), head);
        changes_.push_back(std::move(change));
    }

    void judge(const MatchedCell& cell, const metrics::Metric& metric, const Compared& values, Change& change) const {
        const double own = allowanceOf(metric, *cell.base.front(), values.before(), rules_);
        const bool isDistance = rules_.limits.find(metric.path)->second.best != 0; // a reader knows the value itself
        const Compared shown = isDistance ? Compared{recorded(metric, cell.base), recorded(metric, cell.head)} : values;
        change.base = shown.before();
        change.head = shown.now();
        change.allowance = own + values.meansMayDiffer(rules_);
        change.sentence = sentenceOf(*cell.head.front(), metric.path, shown);
        change.direction = directionOf(values.before(), values.now(), change.allowance);
        if (rules_.limits.find(metric.path)->second.magnitude && turned(metric, cell, change))
            change.direction = Direction::Worse;
        if (values.scatters(rules_, own)) {
            change.direction = Direction::Worse;
            change.sentence += fmt::format(", by seeds {:.3g} around their mean, before {:.3g}", deviation(values.head),
                                           deviation(values.base));
        }
        if (const auto why = whyUnjudged(cell, metric, values, change.direction)) {
            change.direction = Direction::NotCompared;
            change.sentence += ", which is not compared: " + *why;
        }
    }

    [[nodiscard]] std::optional<std::string> whyUnjudged(const MatchedCell& cell, const metrics::Metric& metric,
                                                         const Compared& values, Direction direction) const {
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        if (metric.about == Class::Instructions)
            if (const auto differs = difference(base.environment, head.environment, EnvironmentScope::OfCounts))
                return "counted in different environments, " + *differs + "; count both on one machine";
        const bool same = metric.about == Class::Work ? direction == Direction::Same : values.base == values.head;
        return code_.whyUnjudged(metric, base, head, cell.is(sameImages), same);
    }

    void compareFigures(const MatchedCell& cell) {
        const Record &base = *cell.base.front(), &head = *cell.head.front();
        for (const auto& [name, first] : base.figures) {
            const std::string path = "figures." + name;
            Change change{head.scene, head.variant, path, Class::Figure, first, {}, 0, Direction::Worse, {}};
            const auto now = head.figures.find(name);
            if (now == head.figures.end()) {
                change.direction = Direction::NotCompared;
                change.sentence = fmt::format("{} on {}: {} is no longer reported", head.variant, head.scene, path);
            } else {
                change.head = now->second;
                change.allowance = rules_.figureShare * std::max(std::abs(first), std::abs(now->second)) + rules_.figureStep;
                if (std::abs(now->second - first) <= change.allowance) change.direction = Direction::Same;
                change.sentence = sentenceOf(head, path, {{first}, {now->second}});
            }
            changes_.push_back(std::move(change));
        }
    }

    MetricCode code_;
    const Rules& rules_;
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
            change.direction = Direction::NotCompared;
            change.sentence += fmt::format(", which is not compared: the scene's tolerance is {} and was {}",
                                           curve.toleranceText(), before.toleranceText());
        } else if (is != was) {
            change.direction = is < was ? Direction::Worse : Direction::Better;
        }
        changes.push_back(std::move(change));
    }
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

Comparison compare(const std::vector<Record>& base, const std::vector<Record>& head, const Rules& rules,
                   const std::optional<std::vector<Expected>>& expected) {
    Matched matched = match(base, head, expected);
    Comparison comparison{{}, std::move(matched.presence)};
    for (const Absence& absence : matched.absences)
        comparison.changes.push_back(statusChange(absence.scene, absence.variant,
                                                  absence.isNew ? Direction::Same : Direction::NotCompared, absence.what));
    CellComparison cells(matched.cells, rules, comparison.changes);
    for (const MatchedCell& cell : matched.cells) cells.compareCell(cell);
    compareBreakPoints(curvesOf(base), curvesOf(head), comparison.changes);
    return comparison;
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
            "of another, or say --same-program if that is meant",
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
