#include "tools/mutants/outcome.h"

#include "base/error.h"
#include "gate/judged_shaders.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <iterator>
#include <limits>
#include <set>

namespace shadowbench::mutants {
namespace {

using gate::Change;
using gate::Class;

bool isOf(const Change& change, std::optional<Class> expected) { return expected == change.changeClass; }

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
    if (!outcome.refused.empty()) names.insert("refusal");
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Places of the change beside what is allowed: "31 ×".
std::string excess(const Change& change) {
    const double times = allowances(change);
    return std::isfinite(times) ? fmt::format("{:.3g} ×", times) : "–";
}

/// What was seen of a mutant: a figure, a refusal, or nothing.
std::string seenOf(const Outcome& outcome) {
    if (const auto seen = strongest(outcome)) return figure(*seen);
    return outcome.refused.empty() ? "nothing" : outcome.refused;
}

std::string faultRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    const auto seen = strongest(outcome);
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", mutant.id, fmt::join(mutant.techniques, ", "),
                       mutant.what, expectedText(mutant), seenOf(outcome), seen ? excess(*seen) : "–", otherClasses(outcome),
                       verdict(outcome));
}

/// A fault beside the techniques: where it lies says more than what it was run with.
std::string harnessRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    return fmt::format("| {} | {} | {} | {} | {} | {} |\n", mutant.id, mutant.file.parent_path().string(), mutant.what,
                       expectedText(mutant), seenOf(outcome), verdict(outcome));
}

std::string benignRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    return fmt::format("| {} | {} | {} | {} | {} |\n", mutant.id, fmt::join(mutant.techniques, ", "), mutant.what,
                       outcome.caught()
                           ? fmt::format("{} ({} worse: {})", seenOf(outcome), outcome.worse.size(), otherClasses(outcome))
                           : "nothing",
                       verdict(outcome));
}

std::string shaderRow(const Outcome& outcome) {
    const auto seen = strongest(outcome);
    return fmt::format("| {} | {} | {} | {} | {} |\n", outcome.mutant.id, outcome.mutant.what, outcome.mutant.pass,
                       seen ? seen->sentence : seenOf(outcome), verdict(outcome));
}

std::string slowdownRow(const Outcome& outcome) {
    const Mutant& mutant = outcome.mutant;
    const auto seen = strongest(outcome);
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", mutant.id, fmt::join(mutant.techniques, ", "),
                       fmt::join(mutant.scenes, ", "), mutant.what,
                       outcome.slowdown ? fmt::format("{:+.2f} %", 100 * *outcome.slowdown) : "–", otherClasses(outcome),
                       verdict(outcome));
}

std::vector<Outcome> select(const std::vector<Outcome>& outcomes, const auto& predicate) {
    std::vector<Outcome> result;
    std::ranges::copy_if(outcomes, std::back_inserter(result), predicate);
    return result;
}

/// The word before the colon: all truths, and all tests, are one means.
std::string meansOf(const Outcome& outcome) {
    const std::string text = expectedText(outcome.mutant);
    return text.substr(0, text.find(':'));
}

std::string byClass(const std::vector<Outcome>& outcomes) {
    std::vector<std::string> means; // in the order of the list
    for (const Outcome& outcome : outcomes)
        if (std::ranges::find(means, meansOf(outcome)) == means.end()) means.push_back(meansOf(outcome));
    std::string text = "\n| by | planted | caught by it |\n|---|--:|--:|\n";
    for (const std::string& each : means) {
        const std::vector<Outcome> of = select(outcomes, [&](const Outcome& o) { return meansOf(o) == each; });
        text += fmt::format("| {} | {} | {} |\n", each, of.size(), count(of, &Outcome::caughtInClass));
    }
    return text;
}

std::size_t techniqueCount(const std::vector<Outcome>& outcomes) {
    std::set<std::string> ids;
    for (const Outcome& outcome : outcomes)
        for (const std::string& variant : outcome.mutant.techniques) ids.insert(variant.substr(0, variant.find(':')));
    return ids.size();
}

std::string unexpected(const std::vector<Outcome>& outcomes) {
    std::string text;
    for (const Outcome& outcome : outcomes)
        if (!outcome.asExpected())
            text += fmt::format("* **{}**{}: {}\n", outcome.mutant.id,
                                outcome.caught() ? fmt::format(" (told by {})", otherClasses(outcome)) : "",
                                outcome.mutant.survives.empty() ? "not explained" : outcome.mutant.survives);
    return text.empty() ? text : "\n## Not as expected\n\n" + text;
}

bool isHarness(const Outcome& outcome) { return !outcome.mutant.file.string().starts_with("techniques/"); }

} // namespace

bool Outcome::caughtInClass() const {
    if (mutant.means == Means::Truth || mutant.means == Means::Test) return !refused.empty();
    if (mutant.means == Means::Refusal && !refused.empty()) return true;
    if (mutant.means == Means::Shader)
        return std::ranges::any_of(worse,
                                   [&](const Change& change) { return change.metric.starts_with(mutant.pass + " "); });
    const std::optional<Class> expected = mutant.means == Means::Refusal ? Class::Status : mutant.expected;
    return std::ranges::any_of(worse, [&](const Change& change) { return isOf(change, expected); });
}

std::string verdict(const Outcome& outcome) {
    if (outcome.mutant.benign) return outcome.caught() ? "**false red**" : "green";
    if (outcome.caughtInClass()) return "caught";
    return outcome.caught() ? "caught in another class" : "**survives**";
}

Outcome outcomeOf(const Mutant& mutant, const Trial& base, const Trial& head) {
    Outcome outcome{mutant, {}, {}, head.refused};
    if (mutant.means == Means::Shader && head.refused.empty()) {
        const gate::ShaderJudgement judged = gate::judgeShaders(base.shaders, head.shaders);
        if (!judged.notCompared.empty()) outcome.refused = judged.notCompared.front();
        std::ranges::copy_if(judged.changes, std::back_inserter(outcome.worse),
                             [](const Change& change) { return change.direction == gate::Direction::Worse; });
    }
    if (!mutant.makesRecords() || !head.refused.empty()) return outcome;
    for (Change& change : gate::compare(base.records, head.records).changes) {
        // Other truths, environments or metrics' code: never a silent pass.
        if (change.direction == gate::Direction::NotCompared && outcome.refused.empty()) outcome.refused = change.sentence;
        if (change.changeClass == Class::Instructions && change.base && change.head) {
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
    const auto isBenign = [](const Outcome& o) { return o.mutant.benign; };
    const std::vector<Outcome> benign = select(outcomes, isBenign);
    const std::vector<Outcome> planted = select(outcomes, std::not_fn(isBenign));
    const std::vector<Outcome> slowdowns = select(planted, isSlowdown);
    const auto isShader = [](const Outcome& o) { return o.mutant.means == Means::Shader; };
    const std::vector<Outcome> shaders = select(planted, isShader);
    const std::vector<Outcome> faults = select(planted, [&](const Outcome& o) { return !isSlowdown(o) && !isShader(o); });
    const std::vector<Outcome> techniques = select(faults, std::not_fn(isHarness));
    const std::vector<Outcome> harness = select(faults, isHarness);

    std::string text = fmt::format(
        "# Planted faults, slowdowns and benign changes\n\nMade by `mutants` ({}). Each is one replacement in one file "
        "(`tools/mutants/mutants.toml`). Of faults that are found by records, the mutated and the unmutated program run the "
        "same cells of the gate profile, and their records are compared as `shadowbench compare` does; other faults are "
        "found when a golden reference is computed again (`truth`), by a test (`test`), or by what refuses to go on "
        "(`refusal`).\n\n",
        source);
    text += fmt::format("* All faults and slowdowns: {} detected as expected, {} by something.\n",
                        share(count(planted, &Outcome::caughtInClass), planted.size()),
                        share(count(planted, &Outcome::caught), planted.size()));
    text += fmt::format("* Faults in {} techniques: {} caught in the class they belong to, {} in any class.\n",
                        techniqueCount(techniques), share(count(techniques, &Outcome::caughtInClass), techniques.size()),
                        share(count(techniques, &Outcome::caught), techniques.size()));
    text += fmt::format("* Faults in metrics, truth, records, gate, scenes and loader: {} detected as expected.\n",
                        share(count(harness, &Outcome::caughtInClass), harness.size()));
    const std::vector<Outcome> noticeable =
        select(slowdowns, [](const Outcome& o) { return o.slowdown.value_or(0) >= 0.01; });
    text += fmt::format("* Slowdowns: {} caught by instructions; of 1 % or more, {}.\n",
                        share(count(slowdowns, &Outcome::caughtInClass), slowdowns.size()),
                        share(count(noticeable, &Outcome::caughtInClass), noticeable.size()));
    text += fmt::format("* Slowdowns of shaders: {} named with their pass by figures of machine code.\n",
                        share(count(shaders, &Outcome::caughtInClass), shaders.size()));
    text += fmt::format("* Benign changes: {} red.\n", share(count(benign, &Outcome::caught), benign.size()));
    text += byClass(planted);

    text += "\n## Faults in techniques\n\n`Beyond` is the change in units of what `compare` allows.\n\n"
            "| fault | technique | what | expected | seen | beyond | also worse | verdict "
            "|\n|---|---|---|---|---|--:|---|---|\n";
    for (const Outcome& outcome : techniques) text += faultRow(outcome);
    text +=
        "\n## Faults beside techniques\n\n| fault | in | what | expected | seen | verdict |\n|---|---|---|---|---|---|\n";
    for (const Outcome& outcome : harness) text += harnessRow(outcome);
    text += "\n## Slowdowns\n\n| slowdown | technique | scenes | what | instructions | also worse | verdict |\n"
            "|---|---|---|---|--:|---|---|\n";
    for (const Outcome& outcome : slowdowns) text += slowdownRow(outcome);
    text += "\n## Slowdowns of shaders\n\n| slowdown | what | pass | seen | verdict |\n|---|---|---|---|---|\n";
    for (const Outcome& outcome : shaders) text += shaderRow(outcome);
    text += "\n## Benign changes\n\n| change | technique | what | seen | verdict |\n|---|---|---|---|---|\n";
    for (const Outcome& outcome : benign) text += benignRow(outcome);
    return text + unexpected(outcomes);
}

} // namespace shadowbench::mutants
