// Area-light visibility by densely sampled POV-Ray renders
// (docs/ground-truth.md, "POV-Ray soft shadows").
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace shadowbench::groundtruth::povray {

/// Raise it with every change that can alter a pixel: it is part of every key.
constexpr int codeVersion = 2;

/// Every part of the set holds a point; more than the most could not be told apart in a 16-bit channel.
constexpr int fewestLightSamples = 4;
constexpr int mostLightSamples = 16384;

/// Point `i` of `n` of the low-discrepancy set in [0, 1)² that the light is sampled at: the first two Sobol dimensions, a
/// (0,2)-sequence in base 2, scrambled by Owen's nested permutations and moved to the centres of its cells. Every aligned
/// block of 2^k points is a net of its own. Unscrambled, the points lie on diagonals, and straight edges along these would
/// be sampled badly. Each `set`, below 2³¹, is scrambled in another way.
glm::dvec2 lightSample(int i, int n, std::uint32_t set = 0);

/// How many points of the set each part holds, one after the other.
struct SampleParts {
    int firstQuarter, secondQuarter, secondHalf;
};
SampleParts sampleParts(int samples);

/// How the scene is written for POV-Ray. The defaults are the recipe of every reference; other values are known to give
/// wrong images, for tests that show that a certificate rejects them.
struct Recipe {
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
double scaleOf(const Snapshot& snapshot, const Recipe& recipe = {});

/// The scene text for one snapshot: numbers only, world scaled by scaleOf. With point lights, red, green and blue count
/// the visible samples of the three parts of the set in units of 1/P (blue: ½ P), P the power of two ≥ the part, so that
/// sums are exact; with a grid they hold the visible fractions for grids of n/2 × n/2, n/2 × n and n × n lights (blue: half
/// of it). Blue also has the hit mask's ½. Throws BadInput for a light without area, samples outside [fewestLightSamples,
/// mostLightSamples] and values that are not finite.
std::string sceneText(const Snapshot& snapshot, glm::ivec2 size, int samples, const Recipe& recipe = {});

struct Options {
    std::filesystem::path program = "povray";   // looked up on PATH
    std::chrono::milliseconds limit{1'800'000}; // wall clock of one render
    int threads = 2;                            // pixels do not depend on it
    Recipe recipe{};
};

struct Render {
    Image<float> visible;      // fraction of light samples that are visible: k/N, rounded to float
    Image<float> firstHalf;    // the same of the first half of the set (SampleParts) …
    Image<float> firstQuarter; // … and of its first quarter: what fewer samples would have given
    Image<std::uint8_t> hit;   // 1 where the ray hits something
    double scale = 0;          // scaleOf
};

/// Renders; throws Inconclusive when POV-Ray is missing, fails, is killed, runs over the limit or the disk is full. Leaves
/// no file and no process behind in any case.
Render render(const Snapshot& snapshot, glm::ivec2 size, int samples, const Options& options = {},
              const Progress& progress = {});

/// "3.7.0.10.unofficial". A process asks each program once, whatever its threads do; thread-safe. Throws Inconclusive, each
/// time, naming the package to install when POV-Ray is missing.
std::string version(const Options& options = {});

} // namespace shadowbench::groundtruth::povray
