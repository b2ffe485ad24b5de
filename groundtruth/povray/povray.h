// Area-light visibility by densely sampled POV-Ray renders (GROUNDTRUTH.md: "POV-Ray soft shadows").
#pragma once

#include "groundtruth/reference.h"

#include <chrono>
#include <filesystem>
#include <string>

namespace shadowbench::groundtruth {

/// The scene text for one snapshot: numbers only, world scaled by 1024, one point light per light sample. Red is the visible
/// fraction, blue the hit mask.
std::string povrayScene(const Snapshot& snapshot, glm::ivec2 size, int samples);

struct PovRayOptions {
    std::filesystem::path program = "povray";  // looked up on PATH
    std::chrono::seconds limit{1800};          // wall clock of one render
    int threads = 2;
};

struct PovRayImage {
    Image<float> visible;          // fraction of light samples that are visible
    Image<std::uint8_t> hit;       // 1 where the ray hits something
};

/// Renders; throws Inconclusive when POV-Ray is missing, fails, is killed, runs over the limit or the disk is full.
PovRayImage renderPovRay(const Snapshot& snapshot, glm::ivec2 size, int samples, const PovRayOptions& options = {},
                         const Progress& progress = {});

/// "3.7.0.10.unofficial"; throws Inconclusive naming the package to install when POV-Ray is missing.
std::string povrayVersion(const PovRayOptions& options = {});

/// Point `i` of `n` of the low-discrepancy set in [0, 1)² that the light is sampled at ((0,2)-sequence in base 2, cell-centred).
glm::dvec2 lightSample(int i, int n);

}  // namespace shadowbench::groundtruth
