// `check` of a list of renderers (docs/external.md): whether their adapters draw the exported scene, before any is scored.
#pragma once

#include "gate/check/check.h"

namespace shadowbench::gate {

/// Calls each renderer of the file on each of the small scenes (client_scenes.h) whose light its definition fits, and says
/// what is wrong with the images in terms of what an adapter does; `onResult` gets the results, scene by scene.
/// AccuracyRegression if something is wrong. Throws BadInput as foreign::readRenderers.
ExitCode checkRenderers(const std::filesystem::path& file, const std::function<void(const CheckResult&)>& onResult);

} // namespace shadowbench::gate
