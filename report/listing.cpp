#include "report/listing.h"

#include "base/confined/reader.h"
#include "base/limits.h"
#include "harness/metrics/table.h"
#include "harness/records/record.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

Json techniquesAsJson() {
    Json all = Json::array();
    for (const techniques::Entry& entry : techniques::catalog()) {
        Json parameters = Json::array();
        for (const techniques::Parameter& p : entry.parameters)
            parameters.push_back({{"name", p.name},
                                  {"default", p.defaultValue},
                                  {"values", techniques::describe(p.domain)},
                                  {"meaning", p.meaning},
                                  {"source", p.source}});
        Json figures = Json::array();
        for (const techniques::Figure& figure : entry.figures)
            figures.push_back({{"name", figure.name}, {"meaning", figure.meaning}});
        all.push_back({{"id", entry.id},
                       {"title", entry.title},
                       {"source", techniques::citation(entry.source)},
                       {"answer", answerOf(entry)},
                       {"history", entry.temporal},
                       {"computed", entry.computed},
                       {"lacks", namesOf(lacking(entry))},
                       {"parameters", parameters},
                       {"figures", figures},
                       {"variants", entry.variants}});
    }
    return all;
}

Json scenesAsJson() {
    Json all = Json::array();
    for (const std::string& id : builtinScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        all.push_back({{"id", id},
                       {"title", scene.title},
                       {"shows", scene.shows},
                       {"light", name(scene.light.kind)},
                       {"triangles", snapshot(scene, 0).triangles()},
                       {"frames", scene.timeline.frames()}});
    }
    return all;
}

Json metricsAsJson() {
    Json all = Json::array();
    for (const metrics::Metric& metric : metrics::table)
        all.push_back({{"id", metric.path},
                       {"unit", metric.unit},
                       {"class", metric.about ? name(*metric.about) : ""},
                       {"bound", metric.bound},
                       {"allowance", metric.allowance ? describe(*metric.allowance) : ""},
                       {"not compared", metric.notCompared},
                       {"meaning", metric.meaning}});
    all.push_back({{"id", "figures.*"},
                   {"unit", ""},
                   {"class", name(metrics::Class::Figure)},
                   {"bound", ""},
                   {"allowance", "25 % either way"},
                   {"not compared", ""},
                   {"meaning", "numbers of the scored frame that only the technique knows: see list techniques"}});
    for (const char* passes : {"cost.by_pass", "cost.other_screen"})
        all.push_back({{"id", passes},
                       {"unit", ""},
                       {"class", ""},
                       {"bound", ""},
                       {"allowance", ""},
                       {"not compared", "its sums are: a cost that moves from one pass to another is none"},
                       {"meaning", "work and time pass by pass; on the scored image, and on one of another size"}});
    return all;
}

/// The limits that hold now, and, last, what holds the child that reads files.
Json limitsAsJson() {
    Json all = Json::array();
    for (const LimitEntry& entry : limits())
        all.push_back({{"id", entry.variable},
                       {"limit", limitOf(entry.limit)},
                       {"default", entry.usual},
                       {"most", entry.most},
                       {"meaning", entry.bounds}});
    all.push_back(
        {{"id", "reader"},
         {"limit", ""},
         {"default", ""},
         {"most", ""},
         {"meaning", "foreign meshes and images are read on this system in a child with " + protectionsHere().inWords()}});
    return all;
}

/// A cell of a table: text as it is, parameters with their defaults, figures by name.
std::string asCell(const std::string& key, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    std::vector<std::string> words;
    if (key == "parameters")
        for (const Json& p : value)
            words.push_back(fmt::format("`{}={}`", p["name"].get<std::string>(), p["default"].get<std::string>()));
    else if (key == "figures")
        for (const Json& figure : value) words.push_back(fmt::format("`{}`", figure["name"].get<std::string>()));
    else
        return value.dump();
    return fmt::format("{}", fmt::join(words, " "));
}

/// A line of text or a table row: id first, then the rest.
std::string asText(const Json& entry) {
    std::string text = fmt::format("{}\n", entry["id"].get<std::string>());
    for (const auto& [key, value] : entry.items()) {
        const bool unsaid = value.is_string() && value.get_ref<const std::string&>().empty();
        if (key == "id" || key == "parameters" || key == "figures" || unsaid) continue;
        text += fmt::format("    {}: {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    if (!entry.contains("parameters")) return text;
    for (const Json& p : entry["parameters"])
        text +=
            fmt::format("    {:<10} {:<14} {}, default {}\n", p["name"].get<std::string>(), p["values"].get<std::string>(),
                        p["meaning"].get<std::string>(), p["default"].get<std::string>());
    for (const Json& figure : entry["figures"])
        text += fmt::format("    figures.{}: {}\n", figure["name"].get<std::string>(), figure["meaning"].get<std::string>());
    return text;
}

std::string asMarkdown(const Json& all) {
    std::string header = "|", rule = "|", rows;
    for (const auto& [key, value] : all.front().items()) {
        header += fmt::format(" {} |", key);
        rule += "---|";
    }
    for (const Json& entry : all) {
        rows += "|";
        for (const auto& [key, value] : entry.items()) rows += fmt::format(" {} |", asCell(key, value));
        rows += "\n";
    }
    return fmt::format("{}\n{}\n{}", header, rule, rows);
}

} // namespace

std::string answerOf(const techniques::Entry& entry) {
    using techniques::EnvironmentAnswer;
    if (entry.environment == EnvironmentAnswer::Only) return "soft shadows, environment lights";
    const std::string lights = entry.environment == EnvironmentAnswer::Also ? "any light" : "any light but environments";
    switch (entry.answer) {
    case techniques::Answer::Hard:
        return "hard shadows, " + lights;
    case techniques::Answer::Filtered:
        return "filtered hard shadows, " + lights;
    case techniques::Answer::Soft:
        return "soft shadows, area lights";
    case techniques::Answer::Colour:
        return "pictures of a walk past levels of detail";
    }
    return "";
}

std::string catalogue(const std::string& what, const std::string& format) {
    if (what == "schema") return recordSchema();
    const Json all = what == "scenes"    ? scenesAsJson()
                     : what == "metrics" ? metricsAsJson()
                     : what == "limits"  ? limitsAsJson()
                                         : techniquesAsJson();
    if (format == "json") return all.dump(2) + "\n";
    if (format == "md") return asMarkdown(all);
    std::string text;
    for (const Json& entry : all) text += asText(entry);
    if (what == "techniques") text += "where each is good and where it breaks: docs/techniques/<id>.md\n";
    return text;
}

} // namespace shadowbench
