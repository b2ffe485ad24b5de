#include "gate/judged_cells.h"

#include "base/files.h"
#include "gate/choices.h"
#include "harness/cells/cell.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/lod_cell.h"
#include "harness/cells/truths.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

/// Keys of the scored frame's truths; empty without a tool that they need, which measuring reports.
std::string truthKeys(const Scene& scene) {
    const groundtruth::Cache unused{std::filesystem::path()};
    const Truths truths(scene, unused);
    std::string keys;
    try {
        for (const Truth truth : truthsOf(scene.light)) keys += truths.key(truth, scene.timeline.still - 1) + "\n";
    } catch (const Inconclusive&) {
        return "";
    }
    return keys;
}

JudgedScene loadJudged(const std::string& idOrFile, Profile profile) {
    const Scene scene = loadScene(idOrFile, profile, metrics::boundedMetrics()); // to refuse it now
    const std::vector<std::string> builtin = builtinScenes();
    const bool isFile = std::ranges::find(builtin, idOrFile) == builtin.end();
    return {.id = scene.id,
            .argument = isFile ? fs::absolute(idOrFile).string() : idOrFile,
            .content = isFile ? readFile(idOrFile) : "",
            .truths = truthKeys(scene),
            .variants = {}};
}

std::vector<std::string> namesOf(const GateOptions& options) {
    std::vector<std::string> names;
    for (const techniques::Variant& variant : shadowbench::chosenVariants(options.techniques, options.external.get()))
        names.push_back(variant.name);
    return names;
}

bool isExternal(const std::string& variant) { return variant.starts_with(externalPrefix); }

/// Those of `variants` that a rule of `scene` covers; all of them if no rule names any of the scenes.
std::vector<std::string> coveredOf(const std::vector<GateRule>& rules, const std::vector<JudgedScene>& scenes,
                                   const std::string& scene, const std::vector<std::string>& variants) {
    const auto isJudged = [&](const GateRule& w) {
        return std::ranges::find(scenes, w.scene, &JudgedScene::id) != scenes.end();
    };
    if (std::ranges::none_of(rules, isJudged)) return variants;
    std::vector<std::string> result;
    for (const std::string& variant : variants)
        if (std::ranges::any_of(rules, [&](const GateRule& w) { return w.scene == scene && w.covers(variant); }))
            result.push_back(variant);
    return result;
}

bool has(const MeasuredProgram& program, const JudgedScene& scene) {
    return !scene.content.empty() || program.knowsScene(scene.id);
}

bool isBuiltin(const std::string& scene) {
    const std::vector<std::string> builtin = builtinScenes();
    return std::ranges::find(builtin, scene) != builtin.end();
}

/// The canonical name of a variant that another build shows; nothing if this one does not have it.
std::optional<std::string> ownName(const std::string& variant) {
    try {
        return techniques::parseVariant(variant).name;
    } catch (const BadInput&) {
        return std::nullopt;
    }
}

template <class Predicate>
std::vector<std::string> select(const std::vector<std::string>& all, const Predicate& predicate) {
    std::vector<std::string> some;
    std::ranges::copy_if(all, std::back_inserter(some), predicate);
    return some;
}

/// A run or sweep of one scene, without its techniques.
std::vector<std::string> arguments(const char* verb, const JudgedScene& scene, Profile profile, std::uint32_t seed,
                                   const std::vector<std::string>& more) {
    std::vector<std::string> words{verb,     "--scene",           scene.argument, "--profile", std::string(name(profile)),
                                   "--seed", std::to_string(seed)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// What the base judges and this build cannot.
Change goneOf(const std::string& scene, const std::string& variant, const std::string& why) {
    const std::string what = variant == "*" ? "the scene " + scene : variant;
    return {scene, variant, "status", Class::Status, {}, {}, 0, Direction::NotCompared, fmt::format("{}, {}", what, why)};
}

/// Whether choices are tried there: on an area light those of soft techniques only, for others do the same as elsewhere.
bool belongsTo(const Scene& scene, const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    if (variant.isLod()) return !lod::notApplicable(scene);
    return !notApplicable(scene, variant) && (!scene.light.isArea() || variant.entry->answer == techniques::Answer::Soft);
}

} // namespace

JudgedCells::JudgedCells(const GateOptions& options, const std::optional<Policy>& base,
                         const std::vector<std::string>& baseVariants)
    : profile(options.profile), seed(options.seed), externalFiles_(options.externalFiles) {
    policy = readPolicy(options.bounds, options.profile);
    if (base) {
        Union both = unite(*base, policy);
        policy = std::move(both.policy);
        loosened = std::move(both.loosened);
    }
    const std::vector<std::string> chosen = chosenVariants(options, baseVariants);
    const auto addCovered = [&](const std::string& scene, const GateRule* only) {
        if (options.scenes.empty() && !isBuiltin(scene))
            return gone.push_back(goneOf(scene, "*", "which the base judges, no longer exists"));
        addScene(scene, select(chosen, [&](const std::string& v) { return only == nullptr || only->covers(v); }),
                 only != nullptr);
    };
    for (const std::string& scene : options.scenes.empty() ? policy.standard : options.scenes) addCovered(scene, nullptr);
    if (options.scenes.empty()) {
        for (const GateRule& rule : policy.config.scenes) addCovered(rule.scene, &rule);
        addChoices(options, chosen);
    }
    for (const GateRule& rule : policy.config.counted) addNamed(rule, chosen); // cheap ones that run the code of those shown
    if (options.techniques.empty())
        for (const BoundRule& bound : policy.config.bounds) addNamed(bound.cells, chosen); // else a bound would meet nothing
}

void JudgedCells::addScene(const std::string& argument, std::vector<std::string> variants, bool isBeside) {
    if (variants.empty()) return;
    JudgedScene judged = loadJudged(argument, profile);
    const auto known = std::ranges::find(scenes, judged.id, &JudgedScene::id);
    JudgedScene& scene = known == scenes.end() ? scenes.emplace_back(std::move(judged)) : *known;
    if (known == scenes.end()) scene.isBeside = isBeside;
    for (std::string& variant : variants)
        if (std::ranges::find(scene.variants, variant) == scene.variants.end()) scene.variants.push_back(std::move(variant));
}

void JudgedCells::addNamed(const GateRule& rule, const std::vector<std::string>& chosen) {
    const auto scene = std::ranges::find(scenes, rule.scene, &JudgedScene::id);
    if (scene == scenes.end()) return;
    for (const std::string& variant : rule.named()) {
        const bool isOfChosen = std::ranges::any_of(chosen, [&](const std::string& other) {
            return techniques::idOfVariant(other) == techniques::idOfVariant(variant);
        });
        if (isOfChosen && std::ranges::find(scene->variants, variant) == scene->variants.end())
            scene->variants.push_back(variant);
    }
}

std::vector<std::string> JudgedCells::chosenVariants(const GateOptions& options,
                                                     const std::vector<std::string>& baseVariants) {
    std::vector<std::string> chosen = namesOf(options);
    if (!options.techniques.empty()) return chosen;
    for (const std::string& variant : baseVariants) {
        const std::optional<std::string> name = ownName(variant);
        if (!name) {
            gone.push_back(goneOf("*", variant, "which the base shows, no longer exists"));
        } else if (std::ranges::find(chosen, *name) == chosen.end()) {
            chosen.push_back(*name);
            loosened.push_back(fmt::format("{}, which the base shows, is shown no longer", *name));
        }
    }
    return chosen;
}

void JudgedCells::addChoices(const GateOptions& options, const std::vector<std::string>& chosen) {
    for (const GateRule& rule : policy.config.choices) {
        const auto isChosen = [&](const std::string& id) {
            return rule.covers(id) &&
                   std::ranges::any_of(chosen, [&](const std::string& v) { return techniques::idOfVariant(v) == id; });
        };
        if (std::ranges::none_of(techniques::catalog(), isChosen, &techniques::Entry::id)) continue;
        const std::string file = (options.bounds.parent_path() / rule.scene).string();
        if (!fs::exists(file)) {
            gone.push_back(goneOf(rule.scene, "*", "on which the base judges choices, no longer exists"));
            continue;
        }
        const Scene scene = loadScene(file, profile);
        std::vector<std::string> variants;
        for (const techniques::Entry& entry : techniques::catalog())
            if (isChosen(entry.id))
                for (std::string& variant : pairwiseVariants(entry))
                    if (!rule.excludes(variant) && belongsTo(scene, variant)) variants.push_back(std::move(variant));
        addScene(file, std::move(variants), true);
    }
}

void JudgedCells::addSteps(const MeasuredProgram& program, const JudgedScene& scene, bool instructions,
                           std::vector<Step>& steps) const {
    const std::vector<std::string> known = select(scene.variants, [&](const auto& v) { return program.knowsVariant(v); });
    const auto counted =
        instructions ? coveredOf(policy.config.counted, scenes, scene.id, known) : std::vector<std::string>{};
    const auto add = [&](const std::string& name, std::uint32_t with, const char* cost,
                         const std::vector<std::string>& variants) {
        if (!variants.empty())
            steps.push_back({name, arguments("run", scene, profile, with, {"--cost", cost, "--shard", "1/1"}), variants,
                             "cells", scene.content + scene.truths, false, scene.id, with});
    };
    add(scene.id, seed, "none",
        select(known, [&](const auto& v) { return std::ranges::find(counted, v) == counted.end(); }));
    add(scene.id + ", instructions", seed, "instructions", counted);
    const std::vector<std::string> byChance =
        select(known, [&](const auto& v) { return policy.config.isByChance(scene.id, v); });
    for (std::uint32_t other = seed + 1; other < seed + seedsOfChance; ++other)
        add(fmt::format("{}, seed {}", scene.id, other), other, "none", byChance);
}

std::vector<Step> JudgedCells::steps(const MeasuredProgram& program, bool instructions) const {
    std::vector<Step> steps;
    for (const JudgedScene& scene : scenes)
        if (has(program, scene)) addSteps(program, scene, instructions, steps);
    std::set<std::array<std::string, 3>> known; // a sweep by two entries is the first's
    for (const SweepRule& sweep : policy.config.sweeps) {
        const auto scene = std::ranges::find(scenes, sweep.cells.scene, &JudgedScene::id);
        if (scene == scenes.end() || !has(program, *scene)) continue;
        std::vector<std::string> more{"--axis", sweep.axis};
        for (const double value : sweep.values) more.insert(more.end(), {"--values", fmt::format("{}", value)});
        const std::vector<std::string> swept = select(scene->variants, [&](const auto& v) {
            return program.knowsVariant(v) && sweep.cells.covers(v) && known.insert({scene->id, sweep.axis, v}).second;
        });
        if (!swept.empty())
            steps.push_back({fmt::format("{} over {}", scene->id, sweep.axis),
                             arguments("sweep", *scene, profile, seed, more), swept, "sweep.jsonl",
                             scene->content + scene->truths, false, scene->id, seed});
    }
    return steps;
}

std::vector<Step> JudgedCells::externalSteps() const {
    std::vector<std::string> more{"--cost", "none", "--images"};
    for (const fs::path& file : externalFiles_) more.insert(more.end(), {"--external", fs::absolute(file).string()});
    std::vector<Step> steps;
    for (const JudgedScene& scene : scenes) {
        const std::vector<std::string> variants = select(scene.variants, isExternal);
        if (variants.empty()) continue;
        if (const auto same = std::ranges::find(steps, variants, &Step::techniques); same != steps.end())
            same->arguments.insert(same->arguments.end(), {"--scene", scene.argument});
        else
            steps.push_back({.name = "other renderers",
                             .arguments = arguments("run", scene, profile, seed, more),
                             .techniques = variants,
                             .records = "results.jsonl",
                             .callsRenderers = true});
    }
    return steps;
}

std::vector<TimedCell> JudgedCells::timedCells(const MeasuredProgram& base, const MeasuredProgram& head) const {
    std::vector<TimedCell> cells;
    for (const JudgedScene& scene : scenes) {
        if (!has(base, scene)) continue;
        std::vector<std::string> known;
        std::ranges::copy_if(scene.variants, std::back_inserter(known), [&](const std::string& variant) {
            return !isExternal(variant) && !techniques::parseVariant(variant).isLod() && base.knowsVariant(variant) &&
                   head.knowsVariant(variant);
        });
        for (const std::string& variant : coveredOf(policy.config.timed, scenes, scene.id, known))
            if (!notApplicable(loadScene(scene.argument, profile), techniques::parseVariant(variant)))
                cells.push_back({scene.argument, variant});
    }
    return cells;
}

std::size_t JudgedCells::leaveOut(const std::function<bool(const JudgedScene& scene, const std::string& variant)>& isOut) {
    std::size_t left = 0;
    for (JudgedScene& scene : scenes)
        left += std::erase_if(scene.variants, [&](const std::string& variant) { return isOut(scene, variant); });
    return left;
}

bool JudgedCells::chooses(const std::string& scene, const std::string& variant) const {
    return std::ranges::any_of(scenes, [&](const JudgedScene& judged) {
        return judged.id == scene && std::ranges::find(judged.variants, variant) != judged.variants.end();
    });
}

std::vector<Expected> JudgedCells::expected(const MeasuredProgram* base) const {
    std::vector<Expected> all;
    for (const JudgedScene& scene : scenes)
        for (const std::string& variant : scene.variants)
            all.push_back({scene.id, variant, base != nullptr && (!has(*base, scene) || !base->knowsVariant(variant))});
    return all;
}

} // namespace shadowbench::gate
