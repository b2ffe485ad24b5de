#include "harness/gate/verdict.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace shadowbench::gate {
namespace {

bool isCost(const Change& change) {
    return change.changeClass == Class::Work || change.changeClass == Class::Instructions ||
           change.changeClass == Class::Time;
}

bool isWorse(const Change& change) { return change.direction == Direction::Worse; }

std::ptrdiff_t count(const std::vector<Change>& changes, Direction direction) {
    return std::ranges::count(changes, direction, &Change::direction);
}

std::string totals(const std::vector<Change>& changes) {
    std::string text = fmt::format("{} worse, {} better, {} the same", count(changes, Direction::Worse),
                                   count(changes, Direction::Better), count(changes, Direction::Same));
    if (const auto unclear = count(changes, Direction::Unclear)) text += fmt::format(", {} unclear", unclear);
    if (const auto unjudged = count(changes, Direction::Unjudged)) text += fmt::format(", {} not judged", unjudged);
    return text;
}

constexpr std::array headings{std::pair{Direction::Worse, "worse"}, std::pair{Direction::Unjudged, "not judged"},
                              std::pair{Direction::Unclear, "unclear"}, std::pair{Direction::Better, "better"}};

std::string asText(const std::vector<Change>& changes) {
    std::string text;
    for (const auto& [direction, heading] : headings)
        for (const Change& change : changes)
            if (change.direction == direction)
                text += fmt::format("{:<10} {:<13} {}\n", heading, name(change.changeClass), change.sentence);
    return text + totals(changes) + "\n";
}

std::string asMarkdown(const std::vector<Change>& changes) {
    std::string text = fmt::format("**{}**\n", totals(changes));
    for (const auto& [direction, heading] : headings) {
        if (count(changes, direction) == 0) continue;
        text += fmt::format("\n| {} | class |\n|---|---|\n", heading);
        for (const Change& change : changes)
            if (change.direction == direction)
                text += fmt::format("| {} | {} |\n", change.sentence, name(change.changeClass));
    }
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

/// What became of one test case: the worst of its changes, with their sentences.
struct Outcome {
    std::string worse, unjudged, unclear;

    /// JUnit's element for it; nothing for one that passed.
    [[nodiscard]] std::string_view element() const {
        if (!worse.empty()) return "failure";
        if (!unjudged.empty()) return "error";
        return unclear.empty() ? "" : "skipped";
    }
};

using Case = std::pair<std::string, std::string>; // variant, class
using Cases = std::map<Case, Outcome>;

void add(const Change& change, Outcome& outcome) {
    if (change.direction == Direction::Worse) outcome.worse += change.sentence + "\n";
    if (change.direction == Direction::Unjudged) outcome.unjudged += change.sentence + "\n";
    if (change.direction == Direction::Unclear) outcome.unclear += change.sentence + "\n";
}

std::string testCase(const std::string& scene, const Case& id, const Outcome& outcome) {
    const std::string_view element = outcome.element();
    const std::string name = id.first.empty() ? id.second : id.first + ": " + id.second;
    const std::string begin = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escaped(scene), escaped(name));
    if (element.empty()) return begin + "/>\n";
    const std::string_view is = element == "failure" ? "is worse" : element == "error" ? "is not judged" : "is unclear";
    return fmt::format("{}><{} message=\"{} {}\">{}</{}></testcase>\n", begin, element, escaped(id.second), is,
                       escaped(outcome.worse + outcome.unjudged + outcome.unclear), element);
}

std::string suite(const std::string& scene, const Cases& cases) {
    const auto number = [&](std::string_view element) {
        return std::ranges::count_if(cases, [&](const auto& c) { return c.second.element() == element; });
    };
    std::string xml = fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n",
                                  escaped(scene), cases.size(), number("failure"), number("error"), number("skipped"));
    for (const auto& [id, outcome] : cases) xml += testCase(scene, id, outcome);
    return xml + "  </testsuite>\n";
}

} // namespace

ExitCode verdictOf(const std::vector<Change>& changes) {
    if (std::ranges::any_of(changes, [](const Change& c) { return isWorse(c) && !isCost(c); }))
        return ExitCode::AccuracyRegression;
    if (std::ranges::any_of(changes, isWorse)) return ExitCode::CostRegression;
    return count(changes, Direction::Unjudged) > 0 ? ExitCode::Inconclusive : ExitCode::Pass;
}

std::string changesReport(const std::vector<Change>& changes, const std::string& format) {
    return format == "md" ? asMarkdown(changes) : asText(changes);
}

std::string junit(const std::vector<Change>& changes, const std::vector<std::string>& unjudged) {
    std::map<std::string, Cases> scenes;
    for (const Change& change : changes)
        add(change, scenes[change.scene][{change.variant, std::string(name(change.changeClass))}]);
    for (const std::string& sentence : unjudged) scenes["gate"][{"", sentence}].unjudged = sentence;
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"shadowbench\">\n";
    for (const auto& [scene, cases] : scenes) xml += suite(scene, cases);
    return xml + "</testsuites>\n";
}

std::string annotations(const std::vector<Change>& changes) {
    std::string lines;
    for (const Change& change : changes)
        if (isWorse(change))
            lines += fmt::format("::error title={} is worse::{}\n", name(change.changeClass), change.sentence);
        else if (change.direction == Direction::Unjudged || change.direction == Direction::Unclear)
            lines += fmt::format("::warning title={} is not judged::{}\n", name(change.changeClass), change.sentence);
    return lines;
}

} // namespace shadowbench::gate
