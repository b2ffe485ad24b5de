#include "harness/cells/cell_selection.h"

#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>

namespace shadowbench {

std::vector<techniques::Variant> chosenVariants(const std::vector<std::string>& patterns) {
    std::vector<techniques::Variant> variants;
    for (const std::string& pattern : patterns.empty() ? std::vector<std::string>{"*"} : patterns)
        for (techniques::Variant& variant : techniques::matchVariants(pattern)) {
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
    std::vector<Scene> scenes;
    for (const std::string& name : chosenSceneNames(names))
        scenes.push_back(loadScene(name, profile, metrics::boundedMetrics()));
    return scenes;
}

} // namespace shadowbench
