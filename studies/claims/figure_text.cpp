#include "studies/claims/figure_text.h"

#include "harness/metrics/scores.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace {

std::string asText(double number) { return std::isinf(number) ? "none" : fmt::format("{:.4g}", number); }

/// What a figure is, part by part: its metric, the variant, …, where it is taken.
std::vector<std::string> partsOf(const Figure& figure) {
    const std::string of = figure.variant.empty() ? "" : "of " + figure.variant;
    const std::string over = figure.over ? fmt::format("over {} of {}", figure.over->metric, figure.over->variant) : "";
    const std::string on = figure.profile.empty() ? figure.scene : fmt::format("{} ({})", figure.scene, figure.profile);
    const std::string at = figure.value ? fmt::format("at {} {:g}", figure.axis, *figure.value) : "";
    const std::string settles =
        figure.settles ? fmt::format("from the frame on in which it stays ≤ {:g}", *figure.settles) : "";
    return {figure.metric, of, over, "on " + on, at, settles};
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        if (!part.empty()) text += (text.empty() ? "" : " ") + part;
    return text;
}

std::string describe(const Figure& figure) { return joined(partsOf(figure)); }

/// The parts of `parts` that differ from `others`, or those that do not.
std::vector<std::string> parted(std::vector<std::string> parts, const std::vector<std::string>& others, bool differ) {
    for (std::size_t i = 0; i < parts.size(); ++i)
        if ((parts[i] != others[i]) != differ) parts[i].clear();
    return parts;
}

/// Which parts all cases share with the first.
std::vector<std::string> commonParts(const Check& check) {
    std::vector<std::string> common = partsOf(check.cases.front().left);
    for (const Case& place : check.cases) common = parted(common, partsOf(place.left), false);
    return common;
}

using Side = std::optional<double> Sample::*;

/// "58 to 209", or the one number that all are.
std::string range(const std::vector<double>& sorted) {
    const std::string least = asText(sorted.front()), most = asText(sorted.back());
    return least == most ? least : fmt::format("{} to {}", least, most);
}

std::vector<double> numbersOf(const std::vector<Sample>& samples, Side side) {
    std::vector<double> numbers;
    for (const Sample& sample : samples)
        if (sample.*side) numbers.push_back(*(sample.*side));
    std::ranges::sort(numbers);
    return numbers;
}

/// "0.0147", or with the interval of the mean over seeds and over rounds of times: "0.0147 ± 0.0006".
std::string spread(const std::vector<Sample>& samples, Side side, double Sample::*width = &Sample::leftWidth) {
    const std::vector<double> numbers = numbersOf(samples, side);
    if (numbers.empty()) return "missing";
    if (std::isinf(numbers.back())) return range(numbers);
    const auto [mean, seedsWidth] = metrics::meanInterval(numbers);
    double halfWidth = seedsWidth;
    for (const Sample& sample : samples)
        halfWidth = std::hypot(halfWidth, sample.*width / static_cast<double>(samples.size()));
    return halfWidth == 0 ? asText(mean) : fmt::format("{} ± {:.2g}", asText(mean), halfWidth);
}

/// The mean over seeds of what is at a place.
std::string placeOf(const std::vector<Sample>& samples, std::size_t place) {
    std::vector<double> numbers;
    for (const Sample& sample : samples)
        if (sample.places[place]) numbers.push_back(*sample.places[place]);
    return numbers.empty() ? "missing" : asText(metrics::meanInterval(numbers).mean);
}

std::string sign(const Check& check) { return check.atMost ? "≤" : "≥"; }

/// What was found in a case, without what is compared: "0.0147 ≤ 0.5 × 0.0169".
std::string comparison(const Check& check, const std::vector<Sample>& samples) {
    if (!check.growsOver.empty()) {
        std::vector<std::string> values;
        for (std::size_t i = 0; i < check.growsOver.size(); ++i) values.push_back(placeOf(samples, i));
        return fmt::format("{}", fmt::join(values, ", "));
    }
    if (!check.published.empty())
        return fmt::format("rank correlation {} ≥ {:g}", spread(samples, &Sample::left), check.factor);
    const std::string right = check.cases.front().right ? " × " + spread(samples, &Sample::right, &Sample::rightWidth) : "";
    return fmt::format("{} {} {:g}{}", spread(samples, &Sample::left), sign(check), check.factor, right);
}

/// "yes", or in how many of several cases: "yes in 7, no in 4 of 11".
std::string outcome(const Finding& finding) {
    if (finding.outcome != Outcome::Partly) return std::string(name(finding.outcome));
    std::vector<std::string> parts;
    for (const Outcome outcome : {Outcome::Yes, Outcome::No, Outcome::NotToldApart}) {
        const auto count = std::ranges::count(finding.cases, outcome, outcomeOf);
        if (count > 0) parts.push_back(fmt::format("{} in {}", name(outcome), count));
    }
    return fmt::format("{} of {}", fmt::join(parts, ", "), finding.cases.size());
}

std::string seedsOf(const Finding& finding) {
    std::size_t most = 0;
    for (const std::vector<Sample>& samples : finding.cases) most = std::max(most, samples.size());
    return most < 2 ? "" : fmt::format(" ({} seeds)", most);
}

/// Of one case, with all that is compared.
std::string describedOne(const Check& check, const std::vector<Sample>& samples) {
    const Case& place = check.cases.front();
    const std::string found = comparison(check, samples);
    if (!check.growsOver.empty())
        return fmt::format("{} at {} {:g} = {} grows", describe(place.left), place.left.axis,
                           fmt::join(check.growsOver, ", "), found);
    if (!check.published.empty()) return fmt::format("{}: {}", describe(place.left), found);
    if (!place.right) return fmt::format("{} = {}", describe(place.left), found);
    return fmt::format("{} = {} {} {:g} × {} = {}", describe(place.left), spread(samples, &Sample::left), sign(check),
                       check.factor, describe(*place.right), spread(samples, &Sample::right, &Sample::rightWidth));
}

/// Of several cases: what all have in common, and then each by what it has alone.
std::string describedAll(const Check& check, const Finding& finding) {
    const std::vector<std::string> common = commonParts(check);
    const Case& first = check.cases.front();
    std::string text = joined(common);
    if (!check.growsOver.empty())
        text += fmt::format(" grows over {} {:g}", first.left.axis, fmt::join(check.growsOver, ", "));
    if (first.right)
        text += fmt::format(" {} {:g} × that {}", sign(check), check.factor,
                            joined(parted(partsOf(*first.right), partsOf(first.left), true)));
    std::vector<std::string> cases;
    for (std::size_t i = 0; i < check.cases.size(); ++i)
        cases.push_back(fmt::format("{} = {}", joined(parted(partsOf(check.cases[i].left), common, true)),
                                    comparison(check, finding.cases[i])));
    return fmt::format("{}: {}", text, fmt::join(cases, "; "));
}

/// The document's numbers and ours: "; theirs and ours on s: a 57.2, 0.551; b 88.1, 0.87".
std::string table(const Check& check, const Finding& finding) {
    std::string text;
    for (std::size_t c = 0; c < check.cases.size() && !check.published.empty(); ++c) {
        std::vector<std::string> rows;
        for (std::size_t i = 0; i < check.published.size(); ++i)
            rows.push_back(fmt::format("{} {:g}, {}", check.published[i].variant, check.published[i].number,
                                       placeOf(finding.cases[c], i)));
        text += fmt::format("; theirs and ours, {}: {}", check.cases[c].left.metric, fmt::join(rows, "; "));
    }
    return text;
}

} // namespace

std::string describe(const Check& check, const Finding& finding) {
    const std::string text =
        check.cases.size() == 1 ? describedOne(check, finding.cases.front()) : describedAll(check, finding);
    return fmt::format("{}{}: {}{}", text, seedsOf(finding), outcome(finding), table(check, finding));
}

std::string inShort(const Check& check, const Finding& finding) {
    std::vector<Sample> all;
    for (const std::vector<Sample>& samples : finding.cases) all.insert(all.end(), samples.begin(), samples.end());
    const auto rangeOf = [&](Side side) {
        const std::vector<double> numbers = numbersOf(all, side);
        return numbers.empty() ? "missing" : range(numbers);
    };
    std::string found;
    if (!check.growsOver.empty())
        found = comparison(check, finding.cases.front());
    else if (check.cases.front().right)
        found = fmt::format("{} against {}", rangeOf(&Sample::left), rangeOf(&Sample::right));
    else
        found = rangeOf(&Sample::left);
    return fmt::format("{} ({}: {})", check.says, found, outcome(finding));
}

} // namespace shadowbench
