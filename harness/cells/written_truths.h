// A scene's truths as files that need none of this program's code: what `export --truth` writes beside the scene.
//   frame-<n>-<truth>.exr    channels V, sigma, scored, surface, id; of hard truths edge_distance, too
//   frame-<n>-<truth>.json   scene, frame, truth, provenance with the certificate's figures, primary_mismatch
#pragma once

#include "base/progress.h"
#include "harness/cells/scene_frames.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {

/// Every truth that the light has of the scored frame; of moving ones those by which cells are scored.
std::vector<std::pair<Truth, int>> writtenTruths(const Scene& scene);

/// Writes them into `folder` and returns the files' names in it; what an earlier export wrote there and this one does not is
/// removed. Same scene, same bytes. Throws what computing them throws, before a file is touched.
std::vector<std::string> writeTruths(SceneFrames& frames, const std::filesystem::path& folder,
                                     const Progress& progress = {});

/// Removes what writeTruths wrote into `folder`, if it is there, and nothing else.
void removeTruths(const std::filesystem::path& folder);

} // namespace shadowbench
