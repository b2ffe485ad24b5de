// Results of a head that are its base's, for nothing that can decide them has changed (gate/reach.h).
#pragma once

#include "gate/measured_program.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// Whether both programs give the same for a variant on a scene. Of builds that do not say what decides it: no.
bool isKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::string& variant,
             const std::string& scene);

/// Whether both give the same shaders and the same figures of them for a variant, whatever the built-in scene.
bool hasKnownShaders(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::string& variant);

/// Every 64th known result of `steps`, one at least where any is known: which, a hash of the head's commit draws. They are
/// to be measured as a check, without instructions, of which the comparison knows what is no change.
std::vector<Step> sampleOfKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head,
                                const std::vector<Step>& steps);

/// The first result of the sample that the programs give otherwise, as "pcf on trees": in whatever is not of the program.
std::optional<std::string> contradicted(const std::vector<Step>& sample, const Measured& base, const Measured& head);

} // namespace shadowbench::gate
