// Verdicts on claims, from records.
#include "harness/studies/claims/claims.h"

#include "harness/report/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool matches(const Record& record, const Figure& figure) {
    if (!figure.profile.empty() && record.profile != figure.profile) return false;
    if (record.scene != figure.scene || record.sweep.has_value() != figure.value.has_value()) return false;
    if (!record.sweep) return record.variant == figure.variant;
    return record.sweep->axis == figure.axis && record.sweep->value == *figure.value &&
           record.sweep->curve == figure.variant;
}

/// The number in brackets that a path ends with; 0 if it ends with none.
std::size_t frameOf(const std::string& path) {
    const std::size_t bracket = path.find('[');
    return bracket == std::string::npos ? 0 : std::stoul(path.substr(bracket + 1));
}

/// What stands at a path of the record, whose keys are joined by dots; null if nothing does.
Json valueAt(const Record& record, const std::string& path) {
    Json json = Json::parse(toJson(record));
    const std::string keys = path.substr(0, path.find('['));
    for (std::size_t start = 0; start <= keys.size();) {
        const std::size_t end = std::min(keys.find('.', start), keys.size());
        const std::string key = keys.substr(start, end - start);
        if (!json.is_object() || !json.contains(key)) return {};
        Json inner = std::move(json[key]);
        json = std::move(inner);
        start = end + 1;
    }
    const std::size_t frame = frameOf(path);
    if (frame == 0) return json;
    return json.is_array() && frame <= json.size() ? json[frame - 1] : Json();
}

std::optional<double> numberIn(const Json& json) {
    return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

/// The frame, counted from 1, from which on all numbers are at most `bound`.
std::optional<double> settledFrom(const Json& list, double bound) {
    if (!list.is_array() || list.empty()) return std::nullopt;
    std::size_t restless = list.size(); // frames up to the last that exceeds the bound
    while (restless > 0 && list[restless - 1].get<double>() <= bound) --restless;
    return restless == list.size() ? infinity : static_cast<double>(restless + 1);
}

std::optional<double> numberOf(const Figure& figure, const Record& record) {
    const Json value = valueAt(record, figure.metric);
    return figure.settles ? settledFrom(value, *figure.settles) : numberIn(value);
}

/// What a figure is in the records.
using LookUp = std::function<std::optional<double>(const Figure&)>;

Finding examineGrowth(const Check& check, const LookUp& number) {
    Finding finding;
    for (const double place : check.growsOver) {
        Figure there = check.left;
        there.value = place;
        finding.places.push_back(number(there));
    }
    if (std::ranges::any_of(finding.places, [](const auto& value) { return !value; })) return finding;
    finding.holds = std::ranges::adjacent_find(finding.places, std::greater_equal<>()) == finding.places.end();
    return finding;
}

Finding examineOrder(const Check& check, const LookUp& number) {
    Finding finding;
    std::vector<double> ours, theirs;
    for (const Published& row : check.published) {
        Figure figure = check.left;
        figure.variant = row.variant;
        finding.places.push_back(number(figure));
        if (!finding.places.back()) continue;
        ours.push_back(*finding.places.back());
        theirs.push_back(row.number);
    }
    if (ours.size() < check.published.size()) return finding;
    finding.left = rankCorrelation(ours, theirs);
    if (finding.left) finding.holds = *finding.left >= check.factor;
    return finding;
}

Finding examine(const Check& check, const LookUp& number) {
    if (!check.growsOver.empty()) return examineGrowth(check, number);
    if (!check.published.empty()) return examineOrder(check, number);
    Finding finding{number(check.left), {}, {}};
    if (check.right) finding.right = number(*check.right);
    if (!finding.left || (check.right && !finding.right)) return finding;
    const double bound = check.factor * finding.right.value_or(1);
    finding.holds = check.atMost ? *finding.left <= bound : *finding.left >= bound;
    return finding;
}

Verdict verdictOf(const std::vector<Finding>& findings) {
    if (std::ranges::any_of(findings, [](const Finding& f) { return !f.holds; })) return Verdict::NotMeasured;
    const auto held = std::ranges::count_if(findings, [](const Finding& f) { return *f.holds; });
    if (held == 0) return Verdict::NotReproduced;
    return held == std::ssize(findings) ? Verdict::Reproduced : Verdict::Partly;
}

/// The place of each number among all, from 1; equal ones have the mean of their places.
std::vector<double> meanRanks(const std::vector<double>& numbers) {
    std::vector<double> ranks;
    for (const double number : numbers) {
        const auto below = std::ranges::count_if(numbers, [&](double other) { return other < number; });
        const auto equal = std::ranges::count(numbers, number);
        ranks.push_back(static_cast<double>(below) + 0.5 * static_cast<double>(equal + 1));
    }
    return ranks;
}

} // namespace

std::optional<double> lookUp(const Figure& figure, const std::vector<Record>& records,
                             const std::function<void(const Record&)>& found) {
    std::optional<double> number;
    for (const Record& record : records) {
        if (number || !matches(record, figure)) continue;
        number = numberOf(figure, record);
        if (number && found) found(record);
    }
    if (!number || !figure.over) return number;
    Figure divisor = figure;
    divisor.variant = figure.over->variant;
    divisor.metric = figure.over->metric;
    divisor.over.reset();
    const std::optional<double> divided = lookUp(divisor, records, found);
    return divided && *divided != 0 ? std::optional(*number / *divided) : std::nullopt;
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
    case Verdict::Reproduced:
        return "reproduced";
    case Verdict::Partly:
        return "partly";
    case Verdict::NotReproduced:
        return "not reproduced";
    case Verdict::NotTestable:
        return "not testable here";
    case Verdict::NotMeasured:
        return "not measured";
    }
    return "";
}

std::optional<double> rankCorrelation(const std::vector<double>& ours, const std::vector<double>& theirs) {
    const std::vector<double> a = meanRanks(ours), b = meanRanks(theirs);
    const double middle = 0.5 * static_cast<double>(a.size() + 1);
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - middle) * (b[i] - middle);
        aa += (a[i] - middle) * (a[i] - middle);
        bb += (b[i] - middle) * (b[i] - middle);
    }
    return aa > 0 && bb > 0 ? std::optional(ab / std::sqrt(aa * bb)) : std::nullopt;
}

Judgement judge(const Claim& claim, const std::vector<Record>& records) {
    if (!claim.untestable.empty()) return {&claim, Verdict::NotTestable, {}, {}};
    std::vector<std::string> basis;
    const auto found = [&](const Record& record) {
        const std::string name = fmt::format("{}, {}, {}", record.scene, record.profile, report::imageSize(record));
        if (std::ranges::find(basis, name) == basis.end()) basis.push_back(name);
    };
    const auto number = [&](const Figure& figure) { return lookUp(figure, records, found); };
    std::vector<Finding> findings;
    for (const Check& check : claim.checks) findings.push_back(examine(check, number));
    const Verdict verdict = verdictOf(findings);
    return {&claim, verdict, std::move(findings), std::move(basis)};
}

} // namespace shadowbench
