// Area-light visibility by densely sampled POV-Ray renders (GROUNDTRUTH.md: "POV-Ray soft shadows").
#pragma once

#include "groundtruth/reference.h"

#include <chrono>
#include <filesystem>
#include <string>

namespace shadowbench::groundtruth {

/// To be raised with every change that can alter a pixel: it is part of every key.
constexpr int povrayCodeVersion = 1;

/// Every part of the set holds a point; more than the most could not be told apart in a 16-bit channel.
constexpr int fewestLightSamples = 4;
constexpr int mostLightSamples = 16384;

/// Point `i` of `n` of the low-discrepancy set in [0, 1)² that the light is sampled at: the first two Sobol dimensions, a
/// (0,2)-sequence in base 2, moved to the centres of its cells. Every aligned block of 2^k points is a net of its own.
glm::dvec2 lightSample(int i, int n);

/// How many points of the set each part holds, one after the other.
struct SampleParts {
    int firstQuarter, secondQuarter, secondHalf;
};
SampleParts sampleParts(int samples);

/// World units → POV-Ray units: the largest power of two ≤ 1024 that keeps every coordinate below 10⁷. POV-Ray ignores
/// shadow hits nearer than 10⁻³ of its units, so the larger the better; a power of two changes no mantissa.
double povrayScale(const Snapshot& snapshot);

/// The scene text for one snapshot: numbers only, world scaled by povrayScale, one point light per light sample. Red and
/// green count the visible samples of the first and the second half of the set in units of 1/P, P the power of two ≥ the
/// larger half, so that sums are exact; blue is the hit mask. Throws BadInput for a light without area, samples outside [2,
/// mostLightSamples] and values that are not finite.
std::string povrayScene(const Snapshot& snapshot, glm::ivec2 size, int samples);

struct PovRayOptions {
    std::filesystem::path program = "povray";   // looked up on PATH
    std::chrono::milliseconds limit{1'800'000}; // wall clock of one render
    int threads = 2;                            // pixels do not depend on it
};

struct PovRayImage {
    Image<float> visible;      // fraction of light samples that are visible: k/N, rounded to float
    Image<float> firstQuarter; // the same for parts of the set (SampleParts): quarters of the first half …
    Image<float> secondQuarter;
    Image<float> secondHalf; // … and the second half
    Image<std::uint8_t> hit; // 1 where the ray hits something
    double scale = 0;        // povrayScale
};

/// Renders; throws Inconclusive when POV-Ray is missing, fails, is killed, runs over the limit or the disk is full. Leaves
/// no file and no process behind in any case.
PovRayImage renderPovRay(const Snapshot& snapshot, glm::ivec2 size, int samples, const PovRayOptions& options = {},
                         const Progress& progress = {});

/// "3.7.0.10.unofficial"; throws Inconclusive naming the package to install when POV-Ray is missing.
std::string povrayVersion(const PovRayOptions& options = {});

} // namespace shadowbench::groundtruth
