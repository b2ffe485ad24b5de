// Which cells a run has: the chosen scenes, in each the chosen variants.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/entry.h"

#include <string>
#include <vector>

namespace shadowbench {

class ExternalTechniques;

/// The variants that match the patterns (variants or globs), each once, in the order of the patterns; all if there is none.
/// Patterns that begin with "external:" are of `external`, which must outlive the variants; null: there are none. Throws
/// BadInput for a pattern that matches nothing.
std::vector<techniques::Variant> chosenVariants(const std::vector<std::string>& patterns,
                                                const ExternalTechniques* external = nullptr);

/// What loads the chosen scenes: ids or files as given; the standard scenes if there is none.
std::vector<std::string> chosenSceneNames(const std::vector<std::string>& names);

/// Those scenes. Throws what loading throws.
std::vector<Scene> chosenScenes(const std::vector<std::string>& names, Profile profile);

} // namespace shadowbench
