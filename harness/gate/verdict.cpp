#include "harness/gate/verdict.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace shadowbench::gate {
namespace {

bool isCost(const Change& change) { return change.changeClass == Class::Instructions || change.changeClass == Class::Time; }

bool isWorse(const Change& change) { return change.direction == Direction::Worse; }

std::ptrdiff_t count(const std::vector<Change>& changes, Direction direction) {
    return std::ranges::count(changes, direction, &Change::direction);
}

std::string totals(const std::vector<Change>& changes) {
    return fmt::format("{} worse, {} better, {} the same", count(changes, Direction::Worse),
                       count(changes, Direction::Better), count(changes, Direction::Same));
}

constexpr std::array headings{std::pair{Direction::Worse, "worse"}, std::pair{Direction::Better, "better"}};

std::string asText(const std::vector<Change>& changes) {
    std::string text;
    for (const auto& [direction, heading] : headings)
        for (const Change& change : changes)
            if (change.direction == direction)
                text += fmt::format("{:<7} {:<13} {}\n", heading, name(change.changeClass), change.sentence);
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

using Case = std::pair<std::string, std::string_view>; // variant, class
using Cases = std::map<Case, std::string>;             // with the sentences of what is worse

std::string suite(const std::string& scene, const Cases& cases) {
    const auto failed = std::ranges::count_if(cases, [](const auto& c) { return !c.second.empty(); });
    std::string xml =
        fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", escaped(scene), cases.size(), failed);
    for (const auto& [id, failures] : cases) {
        xml += fmt::format("    <testcase classname=\"{}\" name=\"{}: {}\"", escaped(scene), escaped(id.first), id.second);
        xml += failures.empty() ? "/>\n"
                                : fmt::format("><failure message=\"{} is worse\">{}</failure></testcase>\n", id.second,
                                              escaped(failures));
    }
    return xml + "  </testsuite>\n";
}

} // namespace

ExitCode verdictOf(const std::vector<Change>& changes) {
    if (std::ranges::any_of(changes, [](const Change& c) { return isWorse(c) && !isCost(c); }))
        return ExitCode::AccuracyRegression;
    return std::ranges::any_of(changes, isWorse) ? ExitCode::CostRegression : ExitCode::Pass;
}

std::string changesReport(const std::vector<Change>& changes, const std::string& format) {
    return format == "md" ? asMarkdown(changes) : asText(changes);
}

std::string junit(const std::vector<Change>& changes) {
    std::map<std::string, Cases> scenes;
    for (const Change& change : changes) {
        std::string& failures = scenes[change.scene][{change.variant, name(change.changeClass)}];
        if (isWorse(change)) failures += change.sentence + "\n";
    }
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"shadowbench\">\n";
    for (const auto& [scene, cases] : scenes) xml += suite(scene, cases);
    return xml + "</testsuites>\n";
}

std::string annotations(const std::vector<Change>& changes) {
    std::string lines;
    for (const Change& change : changes)
        if (isWorse(change))
            lines += fmt::format("::error title={} is worse::{}\n", name(change.changeClass), change.sentence);
    return lines;
}

} // namespace shadowbench::gate
