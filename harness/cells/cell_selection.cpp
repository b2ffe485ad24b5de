#include "harness/cells/cell_selection.h"

#include "base/error.h"
#include "base/trace.h"
#include "base/words.h"
#include "harness/cells/external_techniques.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

namespace shadowbench {
namespace {

std::vector<techniques::Variant> matchExternal(const std::string& pattern, const ExternalTechniques* external) {
    if (external == nullptr)
        throw BadInput(
            fmt::format("there is no \"{}\" without a file that describes renderers: name it with --external", pattern));
    std::vector<techniques::Variant> matches;
    std::vector<std::string> names;
    for (const techniques::Variant& variant : external->variants()) {
        names.push_back(variant.name);
        if (fnmatch(pattern.c_str(), variant.name.c_str(), 0) == 0) matches.push_back(variant);
    }
    if (matches.empty())
        throw BadInput(fmt::format("no renderer matches \"{}\"{}; there are {}", pattern, didYouMean(pattern, names),
                                   fmt::join(names, ", ")));
    return matches;
}

std::vector<techniques::Variant> matching(const std::string& pattern, const ExternalTechniques* external) {
    return pattern.starts_with(externalPrefix) ? matchExternal(pattern, external) : techniques::matchVariants(pattern);
}

std::vector<std::string> allPatterns(const ExternalTechniques* external) {
    if (external == nullptr) return {"*"};
    return {"*", std::string(externalPrefix) + "*"};
}

} // namespace

std::vector<techniques::Variant> chosenVariants(const std::vector<std::string>& patterns,
                                                const ExternalTechniques* external) {
    const Span span("setup", "techniques");
    std::vector<techniques::Variant> variants;
    for (const std::string& pattern : patterns.empty() ? allPatterns(external) : patterns)
        for (techniques::Variant& variant : matching(pattern, external)) {
            const bool known =
                std::any_of(variants.begin(), variants.end(), [&](const auto& v) { return v.name == variant.name; });
            if (!known) variants.push_back(std::move(variant));
        }
    return variants;
}

std::vector<std::string> chosenSceneNames(const std::vector<std::string>& names) {
    return names.empty() ? standardScenes() : names;
}

std::vector<Scene> chosenScenes(const std::vector<std::string>& names, Profile profile) {
    const Span span("setup", "scenes");
    std::vector<Scene> scenes;
    for (const std::string& name : chosenSceneNames(names))
        scenes.push_back(loadScene(name, profile, metrics::boundedMetrics()));
    return scenes;
}

} // namespace shadowbench
