// Reasons for which several techniques have nothing to do on a scene (Entry::notApplicable).
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace shadowbench::techniques {

struct Entry;

/// The light must be of a kind that the technique's answer is about (Entry::answer, Entry::environment). Asked of every
/// technique by the harness, before Entry::notApplicable.
std::optional<std::string> lightWithoutAnswer(const Scene& scene, const Entry& entry);

/// The light must be somewhere: not a directional one.
std::optional<std::string> lightWithoutPosition(const Scene& scene);

/// The light must have a width and a height: not a linear one.
std::optional<std::string> lightWithoutArea(const Scene& scene);

} // namespace shadowbench::techniques
