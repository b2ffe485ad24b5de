// Area-light visibility by densely sampled POV-Ray renders (GROUNDTRUTH.md: "POV-Ray soft shadows").
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <chrono>
#include <filesystem>
#include <string>

namespace shadowbench::groundtruth {

/// To be raised with every change that can alter a pixel: it is part of every key.
constexpr int povrayCodeVersion = 2;

/// Every part of the set holds a point; more than the most could not be told apart in a 16-bit channel.
constexpr int fewestLightSamples = 4;
constexpr int mostLightSamples = 16384;

/// Point `i` of `n` of the low-discrepancy set in [0, 1)² that the light is sampled at: the first two Sobol dimensions, a
/// (0,2)-sequence in base 2, scrambled by Owen's nested permutations and moved to the centres of its cells. Every aligned
/// block of 2^k points is a net of its own. Unscrambled, the points lie on diagonals: a straight edge along them left an rms
/// error of 0.0067 at 1,024 points and 0.0041 at 4,096, against 0.0025 and 0.0007; other edges gain or lose little.
glm::dvec2 lightSample(int i, int n);

/// How many points of the set each part holds, one after the other.
struct SampleParts {
    int firstQuarter, secondQuarter, secondHalf;
};
SampleParts sampleParts(int samples);

/// How POV-Ray is asked. The defaults are the recipe of every reference; other values are known faults, there so that a test
/// can show a certificate refuse them.
struct PovRayRecipe {
    enum class Lights {
        Points,       // a point light at every lightSample
        Grid,         // POV-Ray's area_light of n × n lights; rectangles and n² samples, n ≥ 4, only
        AdaptiveGrid, // the same with `adaptive 1`: divided further only where the corners of a cell differ
    };
    Lights lights = Lights::Points;
    bool doubleIlluminate = true; // a light counts whichever side of the surface the rounded normal puts it on
    double largestScale = 1024;   // POV-Ray units per world unit; a power of two changes no mantissa
};

/// World units → POV-Ray units: the recipe's largest scale, halved until every coordinate is below 10⁷. POV-Ray ignores
/// shadow hits nearer than 10⁻³ of its units, so the larger the better.
double povrayScale(const Snapshot& snapshot, const PovRayRecipe& recipe = {});

/// The scene text for one snapshot: numbers only, world scaled by povrayScale. With point lights, red, green and blue count
/// the visible samples of the three parts of the set in units of 1/P (blue: ½ P), P the power of two ≥ the part, so that
/// sums are exact; with a grid they hold the visible fractions for grids of n/2 × n/2, n/2 × n and n × n lights (blue: half
/// of it). Blue also has the hit mask's ½. Throws BadInput for a light without area, samples outside [fewestLightSamples,
/// mostLightSamples] and values that are not finite.
std::string povrayScene(const Snapshot& snapshot, glm::ivec2 size, int samples, const PovRayRecipe& recipe = {});

struct PovRayOptions {
    std::filesystem::path program = "povray";   // looked up on PATH
    std::chrono::milliseconds limit{1'800'000}; // wall clock of one render
    int threads = 2;                            // pixels do not depend on it
    PovRayRecipe recipe{};
};

struct PovRayImage {
    Image<float> visible;      // fraction of light samples that are visible: k/N, rounded to float
    Image<float> firstHalf;    // the same of the first half of the set (SampleParts) …
    Image<float> firstQuarter; // … and of its first quarter: what fewer samples would have given
    Image<std::uint8_t> hit;   // 1 where the ray hits something
    double scale = 0;          // povrayScale
};

/// Renders; throws Inconclusive when POV-Ray is missing, fails, is killed, runs over the limit or the disk is full. Leaves
/// no file and no process behind in any case.
PovRayImage renderPovRay(const Snapshot& snapshot, glm::ivec2 size, int samples, const PovRayOptions& options = {},
                         const Progress& progress = {});

/// "3.7.0.10.unofficial"; throws Inconclusive naming the package to install when POV-Ray is missing.
std::string povrayVersion(const PovRayOptions& options = {});

} // namespace shadowbench::groundtruth
