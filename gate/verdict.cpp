#include "gate/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace shadowbench::gate {
namespace {

bool isCost(const Change& change) {
    return change.changeClass == Class::Work || change.changeClass == Class::Instructions ||
           change.changeClass == Class::Shader || change.changeClass == Class::Time;
}

/// In the order of reports; the rest is the same.
constexpr std::array directions{Direction::Worse, Direction::NotCompared, Direction::Unclear, Direction::Waived,
                                Direction::Better};

bool isWorse(const Change& change) { return change.direction == Direction::Worse; }

std::ptrdiff_t count(const std::vector<Change>& changes, Direction direction) {
    return std::ranges::count(changes, direction, &Change::direction);
}

std::string totals(const Comparison& comparison) {
    std::vector<std::string> parts;
    const auto add = [&](Direction direction, std::ptrdiff_t least) {
        const std::ptrdiff_t number = count(comparison.changes, direction);
        if (number >= least) parts.push_back(fmt::format("{} {}", number, name(direction)));
    };
    for (const Direction direction : {Direction::Worse, Direction::Better, Direction::Same}) add(direction, 0);
    for (const Direction direction : {Direction::Unclear, Direction::Waived, Direction::NotCompared}) add(direction, 1);
    return fmt::format("{}; {}", fmt::join(parts, ", "), text(comparison.presence));
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

/// As the text of a workflow command, in which a line break would begin the next one.
std::string asData(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '%' || c == '\n' || c == '\r')
            result += fmt::format("%{:02X}", static_cast<int>(c));
        else
            result += c;
    }
    return result;
}

/// What became of one test case: the worst of its changes, with their sentences.
struct Outcome {
    std::string worse, notCompared, unclear, output;

    /// JUnit's element for it; nothing for one that passed.
    [[nodiscard]] std::string_view element() const {
        if (!worse.empty()) return "failure";
        if (!notCompared.empty()) return "error";
        return unclear.empty() ? "" : "skipped";
    }
};

using Case = std::pair<std::string, std::string>; // variant, class
using Cases = std::map<Case, Outcome>;

void add(const Change& change, Outcome& outcome) {
    if (change.direction == Direction::Worse) outcome.worse += change.sentence + "\n";
    if (change.direction == Direction::NotCompared) outcome.notCompared += change.sentence + "\n";
    if (change.direction == Direction::Unclear || change.direction == Direction::Waived)
        outcome.unclear += change.sentence + "\n";
    if (change.changeClass == Class::Time && change.direction == Direction::Same) outcome.output += change.sentence + "\n";
}

std::string testCase(const std::string& scene, const Case& id, const Outcome& outcome) {
    const std::string_view element = outcome.element();
    const std::string name = id.first.empty() ? id.second : id.first + ": " + id.second;
    const std::string begin = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escaped(scene), escaped(name));
    if (element.empty() && outcome.output.empty()) return begin + "/>\n";
    if (element.empty()) return fmt::format("{}><system-out>{}</system-out></testcase>\n", begin, escaped(outcome.output));
    const std::string_view is = element == "failure" ? "is worse" : element == "error" ? "is not compared" : "is unclear";
    return fmt::format("{}><{} message=\"{} {}\">{}</{}></testcase>\n", begin, element, escaped(id.second), is,
                       escaped(outcome.worse + outcome.notCompared + outcome.unclear), element);
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
    if (count(changes, Direction::NotCompared) > 0) return ExitCode::Inconclusive;
    if (std::ranges::any_of(changes, [](const Change& c) { return isWorse(c) && !isCost(c); }))
        return ExitCode::AccuracyRegression;
    return std::ranges::any_of(changes, isWorse) ? ExitCode::CostRegression : ExitCode::Pass;
}

std::string_view verdictText(ExitCode code) {
    switch (code) {
    case ExitCode::Pass:
        return "pass";
    case ExitCode::CostRegression:
        return "cost regression";
    case ExitCode::AccuracyRegression:
        return "accuracy or stability regression";
    default:
        return "inconclusive";
    }
}

std::string_view name(Direction direction) {
    switch (direction) {
    case Direction::Better:
        return "better";
    case Direction::Same:
        return "the same";
    case Direction::Worse:
        return "worse";
    case Direction::Unclear:
        return "unclear";
    case Direction::NotCompared:
        return "not compared";
    case Direction::Waived:
        return "waived";
    }
    return "";
}

double excess(const Change& change) {
    if (!change.base || !change.head) return std::numeric_limits<double>::infinity();
    const double moved = std::abs(*change.head - *change.base);
    return change.allowance > 0 ? moved / change.allowance : moved > 0 ? 1e12 * moved : 0;
}

std::vector<Change> worstFirst(const std::vector<Change>& changes) {
    std::vector<Change> sorted = changes;
    std::erase_if(sorted, [](const Change& change) { return change.direction == Direction::Same; });
    std::ranges::stable_sort(sorted, [](const Change& a, const Change& b) {
        const auto rank = [](const Change& c) { return std::ranges::find(directions, c.direction) - directions.begin(); };
        return rank(a) != rank(b) ? rank(a) < rank(b) : excess(a) > excess(b);
    });
    return sorted;
}

std::vector<Change> oneACause(const std::vector<Change>& worstFirst) {
    using Cause = std::tuple<std::string, std::string, Class, Direction, std::string>;
    const auto causeOf = [](const Change& c) { // of shaders each is a cause
        return Cause{c.scene, c.variant, c.changeClass, c.direction, c.changeClass == Class::Shader ? c.metric : ""};
    };
    std::map<Cause, int> counts;
    std::vector<Change> worst;
    for (const Change& change : worstFirst)
        if (counts[causeOf(change)]++ == 0) worst.push_back(change);
    for (Change& change : worst)
        if (const int more = counts[causeOf(change)] - 1; more > 0)
            change.sentence += fmt::format(", and {} more of {}", more, name(change.changeClass));
    return worst;
}

std::string changesReport(const Comparison& comparison) {
    std::string text;
    for (const Change& change : worstFirst(comparison.changes))
        text += fmt::format("{:<12} {:<13} {}\n", name(change.direction), name(change.changeClass), change.sentence);
    return text + totals(comparison) + "\n";
}

std::string junit(const std::vector<Change>& changes, const std::vector<std::string>& notCompared) {
    std::map<std::string, Cases> scenes;
    for (const Change& change : changes)
        add(change, scenes[change.scene][{change.variant, std::string(name(change.changeClass))}]);
    for (const std::string& sentence : notCompared) scenes["gate"][{"", sentence}].notCompared = sentence;
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"shadowbench\">\n";
    for (const auto& [scene, cases] : scenes) xml += suite(scene, cases);
    return xml + "</testsuites>\n";
}

std::string annotations(const std::vector<Change>& changes, const std::vector<std::string>& notCompared) {
    std::string lines;
    for (const std::string& sentence : notCompared)
        lines += fmt::format("::warning title=not compared::{}\n", asData(sentence));
    for (const Change& change : oneACause(worstFirst(changes)))
        if (change.direction == Direction::Worse || change.direction == Direction::NotCompared ||
            change.direction == Direction::Unclear)
            lines += fmt::format("::{} title={} is {}::{}\n", isWorse(change) ? "error" : "warning",
                                 name(change.changeClass), name(change.direction), asData(change.sentence));
    return lines;
}

} // namespace shadowbench::gate
