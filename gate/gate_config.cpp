#include "gate/gate_config.h"

#include "base/error.h"
#include "base/files.h"
#include "base/toml_value.h"
#include "harness/metrics/table.h"
#include "harness/records/record.h"
#include "scene/load/load.h"
#include "studies/sweep/axis.h"
#include "techniques/catalog.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <fnmatch.h>

namespace shadowbench::gate {
namespace {

/// Patterns that the catalogue knows, or an error at their place.
std::vector<std::string> readPatterns(const TomlValue& list) {
    std::vector<std::string> patterns;
    for (const TomlValue& entry : list.list()) {
        patterns.push_back(entry.text());
        if (patterns.back().starts_with(externalPrefix)) continue; // of renderers that only their file names
        try {
            techniques::matchVariants(patterns.back());
        } catch (const Error& error) {
            entry.fail(error.what());
        }
    }
    if (patterns.empty()) list.fail("names no technique");
    return patterns;
}

GateRule readGateRule(const TomlValue& entry) {
    GateRule rule{entry.get("scene").text(), readPatterns(entry.get("techniques")), {}, entry.get("reason").text()};
    if (rule.reason.empty()) entry.get("reason").fail("is empty; say it in a few words");
    if (const auto except = entry.find("except")) rule.except = readPatterns(*except);
    return rule;
}

BoundRule readBound(const TomlValue& entry) {
    entry.only({"scene", "techniques", "except", "reason", "metric", "below", "above"});
    const auto below = entry.find("below"), above = entry.find("above");
    if (below.has_value() == above.has_value()) entry.fail("has either \"below\" or \"above\"");
    return {readGateRule(entry),
            {entry.get("metric").oneOf(metrics::boundedMetrics()), (below ? *below : *above).positive(), below.has_value()}};
}

SweepRule readSweep(const TomlValue& entry) {
    entry.only({"scene", "techniques", "except", "reason", "axis", "values"});
    SweepRule sweep{readGateRule(entry), entry.get("axis").text(), {}};
    try {
        axisNamed(sweep.axis);
    } catch (const Error& error) {
        entry.get("axis").fail(error.what());
    }
    if (const auto values = entry.find("values"))
        for (const TomlValue& value : values->list()) sweep.values.push_back(value.number());
    return sweep;
}

GateRule readPlainRule(const TomlValue& entry) {
    entry.only({"scene", "techniques", "except", "reason"});
    return readGateRule(entry);
}

Waiver readWaiver(const TomlValue& entry) {
    entry.only({"scene", "techniques", "class", "reason", "expires"});
    std::vector<std::string> classes;
    for (int c = 0; c <= static_cast<int>(metrics::Class::Status); ++c)
        classes.emplace_back(metrics::name(static_cast<metrics::Class>(c)));
    Waiver waiver{entry.get("scene").text(),
                  {},
                  entry.get("class").oneOf(classes),
                  entry.get("reason").text(),
                  entry.get("expires").text()};
    for (const TomlValue& technique : entry.get("techniques").list()) waiver.techniques.push_back(technique.text());
    if (waiver.reason.empty()) entry.get("reason").fail("is empty; say it in a few words");
    if (fnmatch("[0-9][0-9][0-9][0-9]-[01][0-9]-[0-3][0-9]", waiver.expires.c_str(), 0) != 0)
        entry.get("expires").fail("is no day; write it as \"2026-12-31\"");
    return waiver;
}

template <class Read>
auto readList(const TomlValue& root, const char* key, Read read) {
    std::vector<decltype(read(root))> list;
    if (const auto entries = root.find(key))
        for (const TomlValue& entry : entries->list()) list.push_back(read(entry));
    return list;
}

/// The canonical name; nothing for a technique that is still to come, of which scenes may expect something.
std::optional<std::string> canonical(const std::string& variant) {
    try {
        return techniques::parseVariant(variant).name;
    } catch (const BadInput&) {
        return std::nullopt;
    }
}

bool isGlob(const std::string& pattern) { return pattern.find_first_of("*?[") != std::string::npos; }

bool matches(const std::string& pattern, const std::string& variant) {
    if (variant.starts_with(externalPrefix)) return fnmatch(pattern.c_str(), variant.c_str(), 0) == 0;
    if (!isGlob(pattern)) return canonical(pattern) == variant;
    return fnmatch(pattern.c_str(), techniques::idOfVariant(variant).c_str(), 0) == 0;
}

bool anyMatches(const std::vector<std::string>& patterns, const std::string& variant) {
    return std::ranges::any_of(patterns, [&](const std::string& pattern) { return matches(pattern, variant); });
}

} // namespace

bool GateRule::covers(const std::string& variant) const { return anyMatches(techniques, variant) && !excludes(variant); }

bool GateRule::excludes(const std::string& variant) const { return anyMatches(except, variant); }

std::vector<std::string> GateRule::named() const {
    std::vector<std::string> names;
    for (const std::string& pattern : techniques)
        if (!isGlob(pattern))
            if (auto name = canonical(pattern)) names.push_back(*std::move(name));
    return names;
}

bool Waiver::covers(const std::string& id, const std::string& variant) const {
    const auto names = [&](const std::string& pattern) { // a technique that is gone has no canonical name
        return pattern == variant || matches(pattern, variant);
    };
    return fnmatch(scene.c_str(), id.c_str(), 0) == 0 && std::ranges::any_of(techniques, names);
}

bool GateConfig::isByChance(const std::string& scene, const std::string& variant) const {
    return std::ranges::any_of(seeds, [&](const GateRule& w) { return w.scene == scene && w.covers(variant); });
}

std::vector<std::string> GateConfig::unknownScenes(const std::vector<std::string>& known) const {
    const std::vector<std::string> builtin = builtinScenes();
    std::vector<std::string> named;
    for (const GateRule& rule : scenes) named.push_back(rule.scene);
    for (const BoundRule& bound : bounds) named.push_back(bound.cells.scene);
    for (const SweepRule& sweep : sweeps) named.push_back(sweep.cells.scene);
    for (const GateRule& rule : counted) named.push_back(rule.scene);
    for (const GateRule& rule : timed) named.push_back(rule.scene);
    std::ranges::sort(named);
    named.erase(std::unique(named.begin(), named.end()), named.end());
    std::erase_if(named, [&](const std::string& scene) {
        return std::ranges::find(builtin, scene) != builtin.end() || std::ranges::find(known, scene) != known.end();
    });
    return named;
}

GateConfig readGateConfig(const std::filesystem::path& file, Profile profile) {
    return parseGateConfig(readFile(file), file.string(), profile);
}

GateConfig parseGateConfig(const std::string& text, const std::string& file, Profile profile) {
    const TomlSource source{file, profileNames(), std::string(name(profile))};
    const toml::table table = parseToml(text, source.file);
    const TomlValue root(source, "", table);
    root.only({"scene", "bound", "sweep", "count", "time", "seeds", "choices", "waiver"});
    return {readList(root, "scene", readPlainRule),   readList(root, "bound", readBound),
            readList(root, "sweep", readSweep),       readList(root, "count", readPlainRule),
            readList(root, "time", readPlainRule),    readList(root, "seeds", readPlainRule),
            readList(root, "choices", readPlainRule), readList(root, "waiver", readWaiver)};
}

GateConfig readJudgements(const TomlValue& root) {
    GateConfig config;
    config.bounds = readList(root, "bound", readBound);
    config.waivers = readList(root, "waiver", readWaiver);
    return config;
}

} // namespace shadowbench::gate
