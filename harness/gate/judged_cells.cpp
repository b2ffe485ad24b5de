#include "harness/gate/judged_cells.h"

#include "base/files.h"
#include "harness/cells/cell.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

JudgedScene loadJudged(const std::string& idOrFile, Profile profile) {
    const Scene scene = loadScene(idOrFile, profile, metrics::boundedMetrics()); // to refuse it now
    const std::vector<std::string> builtin = builtinScenes();
    if (std::ranges::find(builtin, idOrFile) != builtin.end()) return {scene.id, idOrFile, "", {}};
    return {scene.id, fs::absolute(idOrFile).string(), readFile(idOrFile), {}};
}

std::vector<std::string> namesOf(const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const std::string& pattern : patterns.empty() ? std::vector<std::string>{"*"} : patterns)
        for (const techniques::Variant& variant : techniques::matchVariants(pattern))
            if (std::ranges::find(names, variant.name) == names.end()) names.push_back(variant.name);
    return names;
}

/// Those of `variants` that a watch of `scene` covers; all of them if no watch names any of the scenes.
std::vector<std::string> coveredOf(const std::vector<Watch>& watches, const std::vector<JudgedScene>& scenes,
                                   const std::string& scene, const std::vector<std::string>& variants) {
    const auto isJudged = [&](const Watch& w) {
        return std::ranges::find(scenes, w.scene, &JudgedScene::id) != scenes.end();
    };
    if (std::ranges::none_of(watches, isJudged)) return variants;
    std::vector<std::string> result;
    for (const std::string& variant : variants)
        if (std::ranges::any_of(watches, [&](const Watch& w) { return w.scene == scene && w.covers(variant); }))
            result.push_back(variant);
    return result;
}

Watchlist readBounds(const GateOptions& options) {
    if (!fs::exists(options.bounds))
        throw Inconclusive(
            fmt::format("the gate's bounds file {} is missing; name another with --bounds", options.bounds.string()));
    return readWatchlist(options.bounds, options.profile);
}

bool has(const MeasuredProgram& program, const JudgedScene& scene) {
    return !scene.content.empty() || program.knowsScene(scene.id);
}

} // namespace

JudgedCells::JudgedCells(const GateOptions& options)
    : watchlist(readBounds(options)), profile(options.profile), seed(options.seed) {
    const std::vector<std::string> chosen = namesOf(options.techniques);
    const auto add = [&](const std::string& scene, const Watch* only) {
        JudgedScene judged = loadJudged(scene, profile);
        std::ranges::copy_if(chosen, std::back_inserter(judged.variants),
                             [&](const std::string& v) { return only == nullptr || only->covers(v); });
        if (!judged.variants.empty()) scenes.push_back(std::move(judged));
    };
    for (const std::string& scene : options.scenes.empty() ? standardScenes() : options.scenes) add(scene, nullptr);
    if (!options.scenes.empty()) return;
    for (const Watch& watch : watchlist.scenes) add(watch.scene, &watch);
}

std::vector<Step> JudgedCells::steps(const MeasuredProgram& program, bool instructions) const {
    const auto knownOn = [&](const JudgedScene& scene) {
        std::vector<std::string> known;
        std::ranges::copy_if(scene.variants, std::back_inserter(known),
                             [&](const auto& v) { return program.knowsVariant(v); });
        return known;
    };
    const auto arguments = [&](const char* verb, const JudgedScene& scene, std::vector<std::string> more) {
        std::vector<std::string> words{
            verb, "--scene", scene.argument, "--profile", std::string(name(profile)), "--seed", std::to_string(seed)};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };

    std::vector<Step> steps;
    const auto add = [&](Step step) {
        if (!step.techniques.empty()) steps.push_back(std::move(step));
    };
    for (const JudgedScene& scene : scenes) {
        if (!has(program, scene)) continue;
        const std::vector<std::string> known = knownOn(scene);
        const auto counted =
            instructions ? coveredOf(watchlist.counted, scenes, scene.id, known) : std::vector<std::string>{};
        std::vector<std::string> others;
        std::ranges::copy_if(known, std::back_inserter(others),
                             [&](const auto& v) { return std::ranges::find(counted, v) == counted.end(); });
        add({scene.id, arguments("run", scene, {"--cost", "none"}), others, "results.jsonl", scene.content});
        add({scene.id + ", instructions", arguments("run", scene, {"--cost", "instructions"}), counted, "results.jsonl",
             scene.content});
    }
    for (const WatchedSweep& sweep : watchlist.sweeps) {
        const auto scene = std::ranges::find(scenes, sweep.cells.scene, &JudgedScene::id);
        if (scene == scenes.end() || !has(program, *scene)) continue;
        std::vector<std::string> more{"--axis", sweep.axis}, swept;
        for (const double value : sweep.values) more.insert(more.end(), {"--values", fmt::format("{}", value)});
        std::ranges::copy_if(knownOn(*scene), std::back_inserter(swept),
                             [&](const auto& v) { return sweep.cells.covers(v); });
        add({fmt::format("{} over {}", scene->id, sweep.axis), arguments("sweep", *scene, more), swept, "sweep.jsonl",
             scene->content});
    }
    return steps;
}

std::vector<TimedCell> JudgedCells::timedCells(const MeasuredProgram& base, const MeasuredProgram& head) const {
    std::vector<TimedCell> cells;
    for (const JudgedScene& scene : scenes) {
        if (!has(base, scene)) continue;
        std::vector<std::string> known;
        std::ranges::copy_if(scene.variants, std::back_inserter(known), [&](const std::string& variant) {
            return !techniques::parseVariant(variant).isLod() && base.knowsVariant(variant) && head.knowsVariant(variant);
        });
        for (const std::string& variant : coveredOf(watchlist.timed, scenes, scene.id, known))
            if (!notApplicable(loadScene(scene.argument, profile), techniques::parseVariant(variant)))
                cells.push_back({scene.argument, variant});
    }
    return cells;
}

bool JudgedCells::chooses(const std::string& scene, const std::string& variant) const {
    return std::ranges::any_of(scenes, [&](const JudgedScene& judged) {
        return judged.id == scene && std::ranges::find(judged.variants, variant) != judged.variants.end();
    });
}

} // namespace shadowbench::gate
