#include "cli/reference.h"
#include "gate/gate.h"
#include "gate/gate_config.h"
#include "harness/cells/golden.h"
#include "scene/load/load.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace shadowbench {
namespace {

/// The scenes that the gate's own file names; outside of the tree, which has it, those of the lock.
std::set<std::string> judged(const ReferenceOptions& options) {
    std::set<std::string> scenes;
    const std::filesystem::path bounds = gate::GateOptions().bounds;
    if (std::filesystem::exists(bounds))
        for (const gate::GateRule& rule : gate::readGateConfig(bounds, options.profile).scenes) scenes.insert(rule.scene);
    else if (std::filesystem::exists(lockFile(options.golden)))
        for (const GoldenEntry& entry : readLock(options.golden).entries) scenes.insert(entry.name.scene);
    return scenes;
}

/// Of them, the built-in ones that are no standard scenes.
std::vector<std::string> judgedBeside(const ReferenceOptions& options) {
    const std::set<std::string> scenes = judged(options);
    const std::vector<std::string> standard = standardScenes();
    std::vector<std::string> beside;
    for (const std::string& id : builtinScenes())
        if (scenes.contains(id) && std::ranges::find(standard, id) == standard.end()) beside.push_back(id);
    return beside;
}

GoldenOptions goldenOptions(const ReferenceOptions& options) {
    return {options.golden, options.profile, options.scenes, judgedBeside(options),
            options.truth,  options.frame,   options.quiet};
}

std::size_t count(const std::vector<GoldenResult>& results, GoldenStatus status) {
    return static_cast<std::size_t>(std::ranges::count(results, status, &GoldenResult::status));
}

void printJson(const std::vector<GoldenResult>& results) {
    auto all = nlohmann::ordered_json::array();
    for (const GoldenResult& result : results)
        all.push_back({{"scene", result.name.scene},
                       {"truth", name(result.name.truth)},
                       {"frame", result.name.frame},
                       {"status", name(result.status)},
                       {"what", result.what},
                       {"note", result.note}});
    fmt::print("{}\n", all.dump(2));
}

/// Identical references made by the same tools need no line.
void printText(const std::vector<GoldenResult>& results) {
    for (const GoldenResult& result : results) {
        if (result.status == GoldenStatus::Identical && result.note.empty()) continue;
        const std::string what = result.what.empty() ? "" : ": " + result.what;
        const std::string note = result.note.empty() ? "" : "; made otherwise: " + result.note;
        fmt::print("{} {} frame {}: {}{}{}\n", result.name.scene, name(result.name.truth), result.name.frame,
                   name(result.status), what, note);
    }
}

std::string summary(const std::vector<GoldenResult>& results) {
    std::string text;
    for (const GoldenStatus status :
         {GoldenStatus::Identical, GoldenStatus::Changed, GoldenStatus::New, GoldenStatus::Gone, GoldenStatus::Unverified})
        if (const std::size_t n = count(results, status); n > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name(status));
    return text;
}

} // namespace

ExitCode verifyGoldenReferences(const ReferenceOptions& options) {
    const std::vector<GoldenResult> results = verifyGolden(goldenOptions(options));
    if (options.json)
        printJson(results);
    else
        printText(results);
    const std::size_t unverified = count(results, GoldenStatus::Unverified);
    const std::size_t differing = results.size() - unverified - count(results, GoldenStatus::Identical);
    if (!options.json)
        fmt::print("{}: {}{}\n", lockFile(options.golden).string(), summary(results),
                   differing > 0 ? "; if that is meant: shadowbench reference --accept" : "");
    if (differing > 0) return ExitCode::AccuracyRegression;
    return unverified > 0 ? ExitCode::Inconclusive : ExitCode::Pass;
}

ExitCode acceptGoldenReferences(const ReferenceOptions& options) {
    const std::vector<GoldenResult> results = acceptGolden(goldenOptions(options));
    if (options.json) {
        printJson(results);
        return ExitCode::Pass;
    }
    printText(results);
    fmt::print("{}: accepted; before: {}\n", lockFile(options.golden).string(), summary(results));
    return ExitCode::Pass;
}

} // namespace shadowbench
