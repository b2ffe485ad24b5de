#include "gate/sarif.h"

#include "base/error.h"
#include "gate/verdict.h"
#include "harness/cells/environment.h"
#include "harness/foreign/renderer.h"

#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using SarifJson = nlohmann::ordered_json;

constexpr const char* ourList = "techniques/catalog.inc"; // where techniques that are ours are listed

struct Place {
    std::string file; // from the root
    int line = 1;
};

/// Of each renderer's row its entry.
std::map<std::string, Place> placesOf(const std::vector<fs::path>& files, const fs::path& root) {
    std::map<std::string, Place> places;
    for (const fs::path& file : files) {
        try {
            for (const foreign::Renderer& renderer : foreign::readRenderers(root / file))
                places.emplace(std::string(externalPrefix) + renderer.id, Place{file.generic_string(), renderer.line});
        } catch (const Error&) { // it may have changed since: its rows are then shown at the file
        }
    }
    return places;
}

/// One a cell and direction: what is worst, and how much more there is.
std::vector<Change> oneACell(const std::vector<Change>& changes) {
    std::map<std::tuple<std::string, std::string, Direction, std::string>, std::size_t> places; // shaders each at its file
    std::vector<Change> cells;
    std::vector<int> more;
    for (const Change& change : worstFirst(changes)) {
        if (change.direction != Direction::Worse && change.direction != Direction::NotCompared) continue;
        const auto [place, isFirst] =
            places.try_emplace({change.scene, change.variant, change.direction, change.file}, cells.size());
        if (!isFirst) {
            ++more[place->second];
            continue;
        }
        cells.push_back(change);
        more.push_back(0);
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (more[i] > 0) cells[i].sentence += fmt::format(", and {} more", more[i]);
    return cells;
}

SarifJson resultOf(const Change& change, const Place& place) {
    const std::string rule(name(change.changeClass));
    SarifJson at;
    at["physicalLocation"]["artifactLocation"]["uri"] = place.file;
    at["physicalLocation"]["region"]["startLine"] = place.line;
    SarifJson result;
    result["ruleId"] = rule;
    result["level"] = change.direction == Direction::Worse ? "error" : "warning";
    result["message"]["text"] = change.sentence;
    result["locations"] = SarifJson::array({at});
    result["partialFingerprints"]["cell/v1"] = change.file.empty()
                                                   ? fmt::format("{} on {}: {}", change.variant, change.scene, rule)
                                                   : fmt::format("{}: {}", change.metric, rule);
    return result;
}

SarifJson rulesOf(const std::vector<Change>& cells) {
    std::set<std::string> names;
    for (const Change& cell : cells) names.emplace(name(cell.changeClass));
    SarifJson rules = SarifJson::array();
    for (const std::string& id : names) {
        SarifJson rule;
        rule["id"] = id;
        rule["shortDescription"]["text"] = "Shadows: " + id;
        rules.push_back(std::move(rule));
    }
    return rules;
}

SarifJson invocationOf(const GateResult& result) {
    SarifJson invocation;
    invocation["executionSuccessful"] = result.notCompared.empty();
    invocation["toolExecutionNotifications"] = SarifJson::array();
    for (const std::string& sentence : result.notCompared) {
        SarifJson notification;
        notification["level"] = "error";
        notification["message"]["text"] = sentence;
        invocation["toolExecutionNotifications"].push_back(std::move(notification));
    }
    return invocation;
}

} // namespace

std::string sarif(const GateResult& result, const GateOptions& options, const fs::path& root) {
    const std::map<std::string, Place> places = placesOf(options.externalFiles, root);
    const Place others{options.externalFiles.empty() ? ourList : options.externalFiles.front().generic_string()};
    const std::vector<Change> cells = oneACell(result.changes);
    SarifJson run;
    run["tool"]["driver"]["name"] = "shadowbench";
    run["tool"]["driver"]["version"] = programVersion();
    run["tool"]["driver"]["rules"] = rulesOf(cells);
    run["invocations"] = SarifJson::array({invocationOf(result)});
    run["results"] = SarifJson::array();
    for (const Change& cell : cells) {
        const auto found = places.find(cell.variant);
        const Place place = found != places.end() ? found->second
                            : cell.file.empty()   ? others
                                                  : Place{"techniques/" + cell.file};
        run["results"].push_back(resultOf(cell, place));
    }
    SarifJson log;
    log["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
    log["version"] = "2.1.0";
    log["runs"] = SarifJson::array({run});
    return log.dump(1, ' ', false, SarifJson::error_handler_t::replace) + "\n";
}

} // namespace shadowbench::gate
