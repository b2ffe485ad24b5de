#include "gate/judged_shaders.h"

#include "gate/verdict.h"
#include "studies/shader_cost/compared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <utility>

namespace shadowbench::gate {
namespace {

using shaders::SharedShader;

/// As of instructions: what a rewrite that means nothing may move. Figures themselves are exact.
constexpr double cyclesAllowed = 0.005;

/// More executed cycles of rewritten loops and branches are certain from here on: more than any rewrite moved them by that
/// compiled to the same (docs/gate.md, "Shaders").
constexpr double rewrittenAllowed = 0.03;

constexpr const char* waves = "Subgroups per SIMD";
constexpr std::array spills{"Spilled VGPRs", "Spilled SGPRs"};

/// What decides of one shader on one architecture.
struct Found {
    Direction direction = Direction::Same;
    std::string what; // "waves 16 → 12"
    double base = 0, head = 0, allowance = 0;
};

/// Whether a figure of which less is better has changed by `allowed` of it or more.
Found foundOf(const std::string& what, double base, double head, double allowed = 0) {
    Found found{Direction::Same, what, base, head, allowed * base};
    constexpr double rounding = 1e-9; // half a per cent is half a per cent
    const double moved = std::abs(head - base), least = allowed * std::min(base, head);
    if (moved > 0 && moved >= least * (1 - rounding)) found.direction = head > base ? Direction::Worse : Direction::Better;
    return found;
}

double of(const shaders::ShaderCost& shader, const char* statistic) { return static_cast<double>(shader.of(statistic)); }

Found cyclesFound(const char* which, double base, double head) {
    const std::string share = base > 0 ? fmt::format("{:+.2f} %", 100 * (head / base - 1)) : "new";
    return foundOf(fmt::format("{} cycles {}", which, share), base, head, cyclesAllowed);
}

Found cyclesOf(const SharedShader& shader) {
    const Found estimated =
        cyclesFound("estimated", of(*shader.before, "Inverse Throughput"), of(*shader.after, "Inverse Throughput"));
    if (!shader.isCounted()) return estimated;
    Found found = cyclesFound("executed", shader.before->executed->cycles64, shader.after->executed->cycles64);
    const bool isSmall = found.head < found.base * (1 + rewrittenAllowed) && estimated.direction != Direction::Worse;
    if (found.direction == Direction::Worse && shader.isRewritten() && isSmall) {
        found.direction = Direction::Unclear;
        found.what += " (loops or branches are written otherwise, and the compiler's estimate is not worse)";
    }
    return found;
}

/// What is worse first, in the order of what weighs most.
Found foundIn(const SharedShader& shader) {
    std::vector<Found> all;
    for (const char* spill : spills) {
        const double base = of(*shader.before, spill), head = of(*shader.after, spill);
        all.push_back(foundOf(fmt::format("{} {} → {}", spill, base, head), base, head));
    }
    const double before = of(*shader.before, waves), after = of(*shader.after, waves);
    Found fewer = foundOf(fmt::format("waves {} → {}", before, after), after, before); // of which more is better
    std::swap(fewer.base, fewer.head);
    all.push_back(std::move(fewer));
    all.push_back(cyclesOf(shader));
    for (const Direction direction : {Direction::Worse, Direction::Unclear, Direction::Better})
        if (const auto found = std::ranges::find(all, direction, &Found::direction); found != all.end()) return *found;
    return all.back();
}

/// The first that weighs most.
Change worstOf(const std::vector<Change>& changes) {
    const std::vector<Change> sorted = worstFirst(changes);
    return sorted.empty() ? changes.front() : sorted.front();
}

/// Of one shader of one variant, its architectures together.
Change changeOf(const std::vector<SharedShader>& shader) {
    std::vector<Change> all;
    std::vector<std::string> worse;
    for (const SharedShader& on : shader) {
        const shaders::ShaderCost& now = *on.after;
        const Found found = foundIn(on);
        const std::string sentence =
            fmt::format("{} on {}: {}: {}", now.name(), now.architecture, found.what, shaders::beforeAndAfter(on));
        all.push_back({now.scene, now.technique, now.place(), Class::Shader, found.base, found.head, found.allowance,
                       found.direction, sentence, "", now.source});
        if (found.direction == Direction::Worse) worse.push_back(now.architecture);
    }
    Change worst = worstOf(all);
    if (worse.size() > 1) worst.sentence += fmt::format("; worse on {}", fmt::join(worse, ", "));
    return worst;
}

std::set<std::string> variantsOf(const shaders::ShaderCosts& costs) {
    std::set<std::string> all;
    for (const shaders::ShaderCost& shader : costs.shaders) all.insert(shader.technique);
    return all;
}

/// "resolve fragment soft/pcss/pcss.frag of 12 variants", of those that the other side has, too; "": none.
std::string listOf(const std::vector<const shaders::ShaderCost*>& lone, const shaders::ShaderCosts& other) {
    const std::set<std::string> known = variantsOf(other);
    std::map<std::string, std::set<std::string>> variants;
    for (const shaders::ShaderCost* shader : lone)
        if (known.contains(shader->technique)) variants[shader->place()].insert(shader->technique);
    std::vector<std::string> parts;
    for (const auto& [place, of] : variants)
        parts.push_back(of.size() == 1 ? fmt::format("{} of {}", place, *of.begin())
                                       : fmt::format("{} of {} variants", place, of.size()));
    return fmt::format("{}", fmt::join(parts, ", "));
}

void addSentence(std::vector<std::string>& sentences, const std::string& begin, const std::string& list) {
    if (!list.empty()) sentences.push_back(begin + list);
}

} // namespace

ShaderJudgement judgeShaders(const shaders::ShaderCosts& base, const shaders::ShaderCosts& head) {
    if (base.compiler != head.compiler)
        return {{},
                {fmt::format("shaders of the base were compiled by {}, those of the head by {}: build both on this machine",
                             base.compiler, head.compiler)},
                {}};
    ShaderJudgement judged;
    const shaders::ComparedShaders compared = shaders::compared(base, head);
    std::map<std::string, std::vector<SharedShader>> byName;
    std::set<std::string> uncounted;
    for (const SharedShader& shader : compared.both) {
        byName[shader.after->name()].push_back(shader);
        if (!shader.isCounted() && (shader.before->executed || shader.after->executed))
            uncounted.insert(shader.after->name());
    }
    for (const auto& [name, shader] : byName) judged.changes.push_back(changeOf(shader));
    addSentence(judged.notes, "shaders that only the head has are compared with none: ", listOf(compared.added, base));
    addSentence(judged.notes, "shaders that only the base has are compared with none: ", listOf(compared.gone, head));
    if (!uncounted.empty())
        judged.notes.push_back(fmt::format("executed cycles of {} shaders were not counted in one frame on both sides: the "
                                           "compiler's estimate of them is compared",
                                           uncounted.size()));
    return judged;
}

ShaderJudgement judgeShaders(const MeasuredProgram& base, const MeasuredProgram& head,
                             const std::vector<std::string>& variants, const std::filesystem::path& out,
                             const Progress& progress) {
    const ShaderFigures now = head.shaderFigures(variants, out / "head", progress);
    if (!now.file && now.code == ExitCode::Inconclusive) // of the machine: the driver is missing
        return {{}, {}, {"shaders are not compared: " + now.last}};
    if (!now.file) return {{}, {"shaders of the head have no figures: " + now.last}, {}};
    const ShaderFigures before = base.shaderFigures(variants, out / "base", progress);
    if (!before.file && before.code == ExitCode::BadInput) // it was built before there was the verb
        return {{}, {}, {"shaders are not compared: the base cannot tell their figures: " + before.last}};
    if (!before.file) return {{}, {"shaders of the base have no figures: " + before.last}, {}};
    ShaderJudgement judged = judgeShaders(shaders::readLines(*before.file), shaders::readLines(*now.file));
    for (const auto& [who, errors] : {std::pair("base", before.errors), std::pair("head", now.errors)})
        for (const std::string& error : errors)
            judged.notCompared.push_back(fmt::format("shaders of the {} have no figures: {}", who, error));
    return judged;
}

std::vector<Change> oneAShader(std::vector<Change> changes) {
    std::vector<Change> all;
    std::map<std::pair<std::string, Direction>, std::vector<Change>> groups; // by shader
    for (Change& change : changes) {
        if (change.changeClass == Class::Shader)
            groups[{change.metric, change.direction}].push_back(std::move(change));
        else
            all.push_back(std::move(change));
    }
    for (const auto& [shader, group] : groups) {
        Change worst = worstOf(group);
        std::vector<std::string> others;
        for (const Change& change : group)
            if (change.variant != worst.variant) others.push_back(change.variant);
        if (!others.empty())
            worst.sentence += fmt::format("; in {} more variant{}: {}", others.size(), others.size() == 1 ? "" : "s",
                                          fmt::join(others, ", "));
        all.push_back(std::move(worst));
    }
    return all;
}

} // namespace shadowbench::gate
