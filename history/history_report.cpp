#include "history/history_report.h"

#include "base/error.h"
#include "base/files.h"
#include "report/summary.h"
#include "report/text_table.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

namespace shadowbench::history {
namespace {

using Json = nlohmann::ordered_json;
using report::TextTable;

const Series& seriesOf(const Findings& f, const LevelChange& change) { return f.history.series[change.series]; }

std::string_view name(gate::Direction direction) { return direction == gate::Direction::Worse ? "worse" : "better"; }

std::string commit(const Findings& f, std::size_t index) { return shortHash(f.history.commits[index].hash); }

std::string count(std::size_t number, const std::string& what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

const Suspects& suspectsOf(const Findings& f, const LevelChange& change) {
    return *std::ranges::find_if(
        f.suspects, [&](const Suspects& s) { return s.old == change.before.last && s.now == change.after.first; });
}

std::string suspectsText(const Suspects& suspects) {
    if (suspects.commits == 0) return "?";
    return suspects.commits == 1 ? "this one" : fmt::format("{}", suspects.commits);
}

TextTable changesTable(const Findings& f) {
    TextTable table{{"metric", "technique", "scene", "", "from", "to", "size", "first seen at", "last without", "suspects"},
                    {}};
    for (const LevelChange& change : f.changes) {
        const Series& series = seriesOf(f, change);
        table.rows.push_back({series.metric, series.variant, series.scene, std::string(name(change.direction)),
                              formatFigure(series.metric, change.before.value),
                              formatFigure(series.metric, change.after.value), fmt::format("{:.2g} %", 100 * change.size),
                              commit(f, change.after.first), commit(f, change.before.last),
                              suspectsText(suspectsOf(f, change))});
    }
    return table;
}

/// What would find the commit among suspects; nothing where there is but one or git does not know.
std::string narrowing(const Findings& f, const Suspects& suspects) {
    if (suspects.commits < 2) return "";
    const auto rounds = static_cast<std::size_t>(std::bit_width(suspects.commits - 1));
    return fmt::format(
        "{} between {} and {} may have made {}; about {}, the next by\n    {}\n    or: git bisect start {} {}\n",
        count(suspects.commits, "commit"), commit(f, suspects.old), commit(f, suspects.now),
        count(suspects.changes.size(), "change"), count(rounds, "round"), narrowingCommand(f, suspects),
        commit(f, suspects.now), commit(f, suspects.old));
}

std::string narrowing(const Findings& f) {
    std::string text;
    for (const Suspects& suspects : f.suspects) text += narrowing(f, suspects);
    return text;
}

/// One row for all metrics of a cell to which the same happened.
TextTable eventsTable(const Findings& f) {
    std::map<std::tuple<std::string, std::string, std::string, std::string, std::size_t>, std::vector<std::string>> rows;
    for (const Event& event : f.events) {
        const Series& s = f.history.series[event.series];
        rows[{event.what, s.variant, s.scene, s.cell, event.commit}].push_back(s.metric);
    }
    TextTable table{{"what", "technique", "scene", "cell", "metrics", "at"}, {}};
    for (const auto& [key, metrics] : rows) {
        const auto& [what, variant, scene, cell, at] = key;
        table.rows.push_back({what, variant, scene, cell,
                              metrics.size() == 1 ? metrics.front() : fmt::format("{}", metrics.size()), commit(f, at)});
    }
    return table;
}

std::string asText(const Findings& f) {
    std::string text = f.changes.empty() ? "" : aligned(changesTable(f));
    if (!f.events.empty()) text += aligned(eventsTable(f));
    for (const std::string& sentence : f.unreadable) text += fmt::format("left out: {}\n", sentence);
    return text + summaryOf(f) + "\n" + narrowing(f);
}

/// "1.69 % (64331f8 … d41c407, 3) → 1.47 % (9afa401 …)": without its commits where there is one level.
std::string levelsText(const Findings& f, const Series& series, const std::vector<Level>& levels) {
    std::vector<std::string> texts;
    for (const Level& level : levels) {
        const std::string value = formatFigure(series.metric, level.value);
        const std::string first = commit(f, level.first), last = commit(f, level.last);
        texts.push_back(fmt::format("{} ({})", value, first == last ? first : fmt::format("{} … {}", first, last)));
    }
    return fmt::format("{}", fmt::join(texts, " → "));
}

/// The series of one metric on one scene, those that change before those that do not.
std::string levelsTable(const Findings& f, const std::string& scene, const std::string& metric) {
    const std::vector<Series>& all = f.history.series;
    TextTable table{{"technique", "cell", "figures", "levels", "smallest rise found", "apart because"}, {}};
    for (const bool changed : {true, false})
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].scene == scene && all[i].metric == metric && (f.levels[i].size() > 1) == changed)
                table.rows.push_back({all[i].variant, all[i].cell, fmt::format("{}", all[i].points.size()),
                                      levelsText(f, all[i], f.levels[i]),
                                      f.smallest[i] ? report::percent(*f.smallest[i]) : "", all[i].apart});
    return markdown(table);
}

std::string commitsTable(const Findings& f) {
    TextTable table{{"commit", "made", "subject"}, {}};
    for (std::size_t i = 0; i < f.history.commits.size(); ++i)
        table.rows.push_back({commit(f, i), f.history.commits[i].date, f.subjects[i]});
    return markdown(table);
}

constexpr const char* reading =
    R"(A figure that is the same in every run changes when it moves by more than the gate's allowance, from commit to commit or, in
small steps, since its level began. Times change where the energy statistic is larger than random orders of all series explain
(E-divisive; one false series in twenty that are said to change), at the likeliest commits; the smallest rise is what the newest
three figures of a series would have to show to be found. `size` is the share of the larger level that the
change is, less where it is but a few allowances. A change is first seen at one commit and was last not there at another that
was measured: the commits between are suspects, the first seen included. Of `edge_error.signed` the magnitude counts. What
the gate would not compare (another truth, rasteriser, machine, code of the metrics) is a series apart, with the reason.
)";

std::string asMarkdown(const Findings& f, bool charts) {
    std::string text = fmt::format("# Past commits\n\n{}.\n\n{}", summaryOf(f), reading);
    text += "\n## What changed\n\n" + (f.changes.empty() ? "Nothing.\n" : markdown(changesTable(f)));
    if (const std::string steps = narrowing(f); !steps.empty())
        text += fmt::format("\n## Narrowing a change to its commit\n\n```\n{}```\n", steps);
    if (!f.events.empty()) text += "\n## What began, vanished, broke off or is in error\n\n" + markdown(eventsTable(f));
    std::string scene;
    for (const auto& [ofScene, metric] : chartedMetrics(f)) {
        if (ofScene != scene) text += fmt::format("\n## {}\n", scene = ofScene);
        text += fmt::format("\n### {}\n\n", metric);
        if (charts) text += fmt::format("![{} on {}]({})\n\n", metric, scene, chartName(metric, scene));
        text += levelsTable(f, scene, metric);
    }
    text += "\n## Commits\n\n" + commitsTable(f);
    if (!f.unreadable.empty()) text += "\n## Left out\n\n";
    for (const std::string& sentence : f.unreadable) text += fmt::format("* {}\n", report::markdownText(sentence));
    return text;
}

Json asJson(const Findings& f, const Level& level) {
    return {{"value", level.value},
            {"figures", level.figures},
            {"first", f.history.commits[level.first].hash},
            {"last", f.history.commits[level.last].hash}};
}

Json seriesJson(const Findings& f, std::size_t index) {
    const Series& series = f.history.series[index];
    Json json{{"scene", series.scene},
              {"variant", series.variant},
              {"cell", series.cell},
              {"metric", series.metric},
              {"class", gate::name(series.metricClass)},
              {"noisy", series.noisy}};
    if (!series.apart.empty()) json["apart"] = series.apart;
    if (f.smallest[index]) json["smallest_rise"] = *f.smallest[index];
    for (const Point& point : series.points)
        json["points"].push_back({{"commit", f.history.commits[point.commit].hash}, {"value", point.value}});
    for (const Level& level : f.levels[index]) json["levels"].push_back(asJson(f, level));
    return json;
}

Json changeJson(const Findings& f, const LevelChange& change) {
    const Series& series = seriesOf(f, change);
    const Suspects& suspects = suspectsOf(f, change);
    Json json{{"scene", series.scene},
              {"variant", series.variant},
              {"cell", series.cell},
              {"metric", series.metric},
              {"direction", name(change.direction)},
              {"size", change.size},
              {"before", asJson(f, change.before)},
              {"after", asJson(f, change.after)}};
    if (suspects.commits > 0) json["suspects"] = suspects.commits;
    if (!suspects.middle.empty()) {
        json["middle"] = suspects.middle;
        json["narrow"] = narrowingCommand(f, suspects);
    }
    return json;
}

Json asJson(const Findings& f) {
    const Json none = Json::array();
    Json json{{"commits", none}, {"changes", none}, {"events", none}, {"series", none}, {"left_out", f.unreadable}};
    for (std::size_t i = 0; i < f.history.commits.size(); ++i) {
        const Commit& c = f.history.commits[i];
        json["commits"].push_back({{"commit", c.hash}, {"date", c.date}, {"subject", f.subjects[i]}});
    }
    for (const LevelChange& change : f.changes) json["changes"].push_back(changeJson(f, change));
    for (const Event& event : f.events)
        json["events"].push_back(
            {{"what", event.what}, {"series", event.series}, {"commit", f.history.commits[event.commit].hash}});
    for (std::size_t i = 0; i < f.history.series.size(); ++i) json["series"].push_back(seriesJson(f, i));
    return json;
}

/// Distinct words of the changes of a set of suspects, for a shell.
template <typename Word>
std::string quoted(const Findings& f, const Suspects& suspects, const Word& word) {
    std::set<std::string> words;
    for (const std::size_t i : suspects.changes) words.insert(word(seriesOf(f, f.changes[i])));
    return fmt::format("'{}'", fmt::join(words, " "));
}

} // namespace

Findings findingsOf(const std::filesystem::path& folder, const Selection& selection) {
    const auto repository = Repository::around(folder);
    Stored stored = readHistory(folder);
    sortByAncestry(stored.commits, repository);
    Findings findings;
    findings.unreadable = stored.unreadable;
    findings.history = historyOf(stored.commits, selection);
    if (findings.history.series.empty())
        throw BadInput(
            fmt::format("{} holds no records of what was asked for; `shadowbench history add` adds some", folder.string()));
    for (const Commit& commit : findings.history.commits)
        findings.subjects.push_back(repository ? repository->subject(commit.hash) : "");
    static_cast<Levels&>(findings) = levelsOf(findings.history, {});
    findings.events = eventsOf(findings.history);
    findings.changes = changesBetween(findings.history, findings.levels);
    findings.suspects = suspectsOf(findings.history, findings.changes, repository);
    return findings;
}

std::string shortHash(const std::string& commit) { return commit.substr(0, 7); }

std::string summaryOf(const Findings& f) {
    const auto happened = [&](const char* what) { return std::ranges::count(f.events, what, &Event::what); };
    const auto began = happened("began"), vanished = happened("vanished"), failing = happened("in error");
    return fmt::format(
        "{} from {} to {}, {} of {} series without a change; {} began, {} vanished, {} broke off, {} in error",
        count(f.history.commits.size(), "commit"), commit(f, 0), commit(f, f.history.commits.size() - 1),
        std::ranges::count(f.levels, 1U, &std::vector<Level>::size), f.levels.size(), began, vanished,
        static_cast<std::ptrdiff_t>(f.events.size()) - began - vanished - failing, failing);
}

Unit unitOf(const std::string& metric) {
    const metrics::Metric* line = metrics::metricAt(metric);
    if (line == nullptr) return {};
    if (line->unit == "share") return {100, " %"};
    if (line->unit == "instructions") return {1e-6, " M"};
    return {};
}

std::string formatFigure(const std::string& metric, double value) {
    const Unit unit = unitOf(metric);
    return fmt::format("{:.5g}{}", unit.factor * value, unit.name);
}

std::string narrowingCommand(const Findings& findings, const Suspects& suspects) {
    return fmt::format("SCENES={} TECHNIQUES={} tools/backfill {}",
                       quoted(findings, suspects, [](const Series& s) { return s.scene; }),
                       quoted(findings, suspects, [](const Series& s) { return s.variant; }), shortHash(suspects.middle));
}

std::string report(const Findings& findings, const std::string& format, bool charts) {
    if (format == "json") return asJson(findings).dump(2) + "\n";
    return format == "md" ? asMarkdown(findings, charts) : asText(findings);
}

std::vector<std::pair<std::string, std::string>> chartedMetrics(const Findings& findings) {
    std::vector<std::pair<std::string, std::string>> metrics;
    for (std::size_t i = 0; i < findings.history.series.size(); ++i) {
        const Series& series = findings.history.series[i];
        const std::pair metric(series.scene, series.metric);
        const bool several = series.points.front().commit != series.points.back().commit;
        const bool shows = series.metricClass != gate::Class::Status || findings.levels[i].size() > 1;
        if (several && shows && (metrics.empty() || metrics.back() != metric)) metrics.push_back(metric);
    }
    return metrics;
}

std::vector<std::filesystem::path> writeReport(const Findings& findings, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files{folder / "report.md"};
    for (const auto& [scene, metric] : chartedMetrics(findings)) {
        files.push_back(folder / chartName(metric, scene));
        writeFile(files.back(), chart(findings, metric, scene));
    }
    writeFile(files.front(), report(findings, "md", true));
    return files;
}

} // namespace shadowbench::history
