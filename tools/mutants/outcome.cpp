#include "tools/mutants/outcome.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <limits>
#include <set>

namespace shadowbench::mutants {
namespace {

using gate::Change;
using gate::Class;

bool isOf(const Change& change, Class expected) { return change.changeClass == expected; }

/// By how many allowances a change exceeds what the base has.
double allowances(const Change& change) {
    if (!change.base || !change.head || change.allowance <= 0) return std::numeric_limits<double>::infinity();
    return (*change.head - *change.base) / change.allowance;
}

std::ptrdiff_t count(const std::vector<Outcome>& outcomes, bool (Outcome::*is)() const) {
    return std::ranges::count_if(outcomes, [&](const Outcome& outcome) { return (outcome.*is)(); });
}

std::string share(std::ptrdiff_t part, std::size_t all) {
    return fmt::format("{} of {} ({:.0f} %)", part, all,
                       all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0);
}

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "–"; }

/// "accuracy.leak 0.0021 → 0.013 on simple".
std::string figure(const Change& change) {
    return fmt::format("`{}` {} → {} on {}", change.metric, number(change.base), number(change.head), change.scene);
}

std::string otherClasses(const Outcome& outcome) {
    std::set<std::string_view> names;
    for (const Change& change : outcome.worse)
        if (!isOf(change, outcome.mutant.expected)) names.insert(name(change.changeClass));
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string verdict(const Outcome& outcome) {
    if (outcome.caughtInClass()) return "caught";
    return outcome.caught() ? "caught in another class" : "**survives**";
}

/// Places of the change beside what is allowed: "31 ×".
std::string excess(const Change& change) {
    const double times = allowances(change);
    return std::isfinite(times) ? fmt::format("{:.3g} ×", times) : "–";
}

std::string faultRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    const auto seen = strongest(outcome);
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", mutant.id, fmt::join(mutant.techniques, ", "),
                       mutant.what, name(mutant.expected), seen ? figure(*seen) : "nothing is worse",
                       seen ? excess(*seen) : "–", otherClasses(outcome), verdict(outcome));
}

std::string slowdownRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    const auto seen = strongest(outcome);
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", mutant.id, fmt::join(mutant.techniques, ", "),
                       fmt::join(mutant.scenes, ", "), mutant.what,
                       outcome.slowdown ? fmt::format("{:+.2f} %", 100 * *outcome.slowdown) : "–", otherClasses(outcome),
                       verdict(outcome));
}

std::vector<Outcome> those(const std::vector<Outcome>& outcomes, const auto& predicate) {
    std::vector<Outcome> result;
    std::ranges::copy_if(outcomes, std::back_inserter(result), predicate);
    return result;
}

std::string byClass(const std::vector<Outcome>& outcomes) {
    std::string text = "\n| class | planted | caught in it |\n|---|--:|--:|\n";
    for (const Class c : {Class::Labels, Class::FalseShadow, Class::Leak, Class::Edge, Class::Penumbra, Class::Colour,
                          Class::Flicker, Class::BreakPoint, Class::Instructions}) {
        const std::vector<Outcome> of = those(outcomes, [&](const Outcome& o) { return o.mutant.expected == c; });
        if (!of.empty()) text += fmt::format("| {} | {} | {} |\n", name(c), of.size(), count(of, &Outcome::caughtInClass));
    }
    return text;
}

std::size_t techniqueCount(const std::vector<Outcome>& outcomes) {
    std::set<std::string> ids;
    for (const Outcome& outcome : outcomes)
        for (const std::string& variant : outcome.mutant.techniques) ids.insert(variant.substr(0, variant.find(':')));
    return ids.size();
}

std::string survivors(const std::vector<Outcome>& outcomes) {
    std::string text;
    for (const Outcome& outcome : outcomes)
        if (!outcome.caughtInClass())
            text += fmt::format("* **{}**{}: {}\n", outcome.mutant.id,
                                outcome.caught() ? fmt::format(" (told by {})", otherClasses(outcome)) : "",
                                outcome.mutant.survives.empty() ? "not explained" : outcome.mutant.survives);
    return text.empty() ? text : "\n## Not caught in their class\n\n" + text;
}

} // namespace

bool Outcome::caughtInClass() const {
    return std::ranges::any_of(worse, [&](const Change& change) { return isOf(change, mutant.expected); });
}

Outcome outcomeOf(const Mutant& mutant, const std::vector<Record>& base, const std::vector<Record>& head) {
    Outcome outcome{mutant, {}, {}};
    for (Change& change : gate::compare(base, head)) {
        if (isOf(change, Class::Instructions) && change.base && change.head) {
            const double slowdown = *change.head / *change.base - 1;
            outcome.slowdown = std::max(outcome.slowdown.value_or(slowdown), slowdown);
        }
        if (change.direction == gate::Direction::Worse) outcome.worse.push_back(std::move(change));
    }
    return outcome;
}

std::optional<Change> strongest(const Outcome& outcome) {
    const auto weaker = [&](const Change& a, const Change& b) {
        const bool inClassA = isOf(a, outcome.mutant.expected), inClassB = isOf(b, outcome.mutant.expected);
        return inClassA != inClassB ? inClassB : allowances(a) < allowances(b);
    };
    const auto found = std::ranges::max_element(outcome.worse, weaker);
    return found == outcome.worse.end() ? std::nullopt : std::optional(*found);
}

std::string mutantsReport(const std::vector<Outcome>& outcomes, const std::string& source) {
    const auto isSlowdown = [](const Outcome& o) { return o.mutant.isSlowdown(); };
    const std::vector<Outcome> slowdowns = those(outcomes, isSlowdown);
    const std::vector<Outcome> faults = those(outcomes, std::not_fn(isSlowdown));

    std::string text = fmt::format(
        "# Planted faults and slowdowns\n\nMade by `mutants` ({}). Each fault is one replacement in one file of the "
        "techniques (`tools/mutants/mutants.toml`); the mutated and the unmutated program run the same cells of the gate "
        "profile, and their records are compared as `shadowbench compare` does.\n\n",
        source);
    text += fmt::format("* Faults of accuracy or stability, in {} techniques: {} caught in the class they belong to, {} in "
                        "any class.\n",
                        techniqueCount(faults), share(count(faults, &Outcome::caughtInClass), faults.size()),
                        share(count(faults, &Outcome::caught), faults.size()));
    const std::vector<Outcome> noticeable =
        those(slowdowns, [](const Outcome& o) { return o.slowdown.value_or(0) >= 0.01; });
    text += fmt::format("* Slowdowns: {} caught by instructions; of 1 % or more, {}.\n",
                        share(count(slowdowns, &Outcome::caughtInClass), slowdowns.size()),
                        share(count(noticeable, &Outcome::caughtInClass), noticeable.size()));
    text += byClass(outcomes);

    text += "\n## Faults\n\n`Beyond` is the change in units of what `compare` allows.\n\n"
            "| fault | technique | what | expected | seen | beyond | also worse | verdict "
            "|\n|---|---|---|---|---|--:|---|---|\n";
    for (const Outcome& outcome : faults) text += faultRow(outcome);
    text += "\n## Slowdowns\n\n| slowdown | technique | scenes | what | instructions | also worse | verdict |\n"
            "|---|---|---|---|--:|---|---|\n";
    for (const Outcome& outcome : slowdowns) text += slowdownRow(outcome);
    return text + survivors(outcomes);
}

} // namespace shadowbench::mutants
