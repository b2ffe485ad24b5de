#include "techniques/folder/unused.h"

#include "base/error.h"
#include "techniques/folder/reading.h"
#include "techniques/folder/vocabulary.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::techniques {
namespace {

using Names = std::set<std::string>;

/// Of each pass's shader, with what it includes.
std::vector<Names> namesOfShaders(const TechniqueFolder& folder) {
    std::vector<Names> names;
    for (const FolderPass& pass : folder.passes)
        names.push_back(pass.shader.empty() ? Names()
                                            : namesIn(gl::loadShader({"", folder.shaders}, pass.shader, pass.defines).text));
    return names;
}

/// Parameters that keys of technique.toml name.
Names parametersOfKeys(const TechniqueFolder& folder) {
    Names names;
    const auto addAmount = [&](const Amount& amount) {
        if (const auto* name = std::get_if<std::string>(&amount)) names.insert(*name);
    };
    const auto addCondition = [&](const std::optional<FolderCondition>& condition) {
        if (condition) names.insert(condition->parameter);
    };
    const FolderCascades& cascades = folder.cascades;
    for (const Amount* amount : {&cascades.count, &cascades.lambda, &cascades.blend, &cascades.latency}) addAmount(*amount);
    for (const FolderWord* word : {&cascades.fit, &cascades.warp, &cascades.stable})
        if (word->ofParameter) names.insert(word->text);
    for (const FolderPattern& pattern : folder.patterns) {
        addAmount(pattern.sigma);
        addAmount(pattern.taps);
    }
    for (const FolderTarget& target : folder.targets) {
        names.insert(target.chosen);
        addAmount(target.side);
        addCondition(target.linearWhen);
    }
    for (const FolderPass& pass : folder.passes) {
        for (const Amount* amount : {&pass.slopeOffset, &pass.unitOffset, &pass.repeat}) addAmount(*amount);
        addCondition(pass.when);
    }
    return names;
}

/// `names`: of the pass's shader. A pass that writes a target has it as an output or an image, and reads it by its tests.
bool reads(const FolderPass& pass, const Names& names, const FolderTarget& target) {
    if (target.history && names.contains(std::string(historyPrefix) + target.name)) return true;
    if (std::ranges::count(pass.to, target.name) == 0)
        return names.contains(target.name) || std::ranges::count(pass.groups, GroupCount(target.name)) > 0;
    if (!isDepth(target.format)) return false;
    const bool testsStencil =
        pass.stencil && (pass.stencil->test != StencilTest::Always || pass.stencil->depthFail != StencilOperation::Keep);
    return testsStencil || (pass.kind == PassKind::Casters && pass.to.size() > 1); // the nearest casters' colours
}

} // namespace

std::vector<std::string> unusedIn(const TechniqueFolder& folder) {
    std::vector<Names> shaders;
    try {
        shaders = namesOfShaders(folder);
    } catch (const InternalError&) {
        return {};
    }
    const Names keys = parametersOfKeys(folder);
    std::vector<std::string> lines;
    for (const Parameter& parameter : folder.entry.parameters) {
        const std::vector<std::string> macros = macrosOf(parameter);
        const auto isNamed = [&](const Names& names) {
            return std::ranges::any_of(macros, [&](const std::string& macro) { return names.contains(macro); });
        };
        const auto place = folder.places.find("parameter." + parameter.name);
        if (place == folder.places.end() || keys.contains(parameter.name) || std::ranges::any_of(shaders, isNamed)) continue;
        lines.push_back(fmt::format("{}: {}: no shader reads {}, and no key names it: use it or leave it out", place->second,
                                    place->first, fmt::join(macros, ", ")));
    }
    for (const FolderTarget& target : folder.targets) {
        bool isRead = false;
        for (std::size_t i = 0; i < shaders.size(); ++i) isRead = isRead || reads(folder.passes[i], shaders[i], target);
        const std::string key = "target." + target.name;
        if (!isRead)
            lines.push_back(fmt::format("{}: {}: no pass reads it: use it or leave it out", folder.places.at(key), key));
    }
    return lines;
}

} // namespace shadowbench::techniques
