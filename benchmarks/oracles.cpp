// What exactness costs: the oracles `polygon` and `rays` against Embree's float shadow rays on the same frame.
//
//   oracles [--triangles 10000,100000,1000000] [--size 512] [--rounds 7] [--threads 2] [--out FILE]
//   oracles --scene street,interior [--profile paper] [--light-rays 64] [--out FILE]
//
// Prints Markdown tables; --out writes them to a file, too. A round measures Embree, polygon and rays one after the other;
// the tables show medians over the rounds. All start from the same primary hits, which are timed apart. Scenes are labelled
// as a run labels them, primary hits included.
#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "benchmarks/bumpy_scene.h"
#include "benchmarks/embree_shadows.h"
#include "benchmarks/peak_memory.h"
#include "benchmarks/shared_hits.h"
#include "groundtruth/oracle.h"
#include "scene/load/load.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace shadowbench::benchmarks {
namespace {

using groundtruth::PrimaryHits;
using groundtruth::Reference;
using groundtruth::hard::ExactScene;

constexpr float tnear = 1e-4F; // of Embree's rays, as a share of the way

struct Settings {
    std::vector<int> triangles{10'000, 100'000, 1'000'000};
    int size = 512, rounds = 7, threads = 2;
    std::vector<std::string> scenes;
    std::string profile = "paper", out;
    int lightRays = 64;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Seconds of one round.
struct Times {
    double embreeBuild, embreeTrace, polygon, distances, rays;
    [[nodiscard]] double embree() const { return embreeBuild + embreeTrace; }
};

Reference polygonLabels(const Snapshot& snapshot, const PrimaryHits& ground, const Settings& settings,
                        double* distances = nullptr) {
    const glm::ivec2 size(ground.id.width(), ground.id.height());
    const ExactScene scene(snapshot, settings.threads);
    Reference out;
    std::chrono::steady_clock::time_point labelled; // the last report before the distances
    for (const groundtruth::hard::PlanarReceiver& receiver : scene.planarReceivers(ground, 1))
        scene.labelByPolygon(size, ground, receiver, out,
                             [&](double, std::string_view) { labelled = std::chrono::steady_clock::now(); });
    if (distances) *distances = secondsSince(labelled);
    return out;
}

Reference rayLabels(const Snapshot& snapshot, const PrimaryHits& ground, const Settings& settings) {
    Reference out;
    ExactScene(snapshot, settings.threads).labelByRays({ground.id.width(), ground.id.height()}, ground, out);
    return out;
}

struct Measured {
    int triangles;
    std::size_t rays;
    double primary;
    std::vector<Times> rounds;
    std::size_t embreeWrong, embreeWrongFromZero, differing, shadowed;

    template <typename Value>
    [[nodiscard]] double of(const Value& value) const {
        std::vector<double> values;
        for (const Times& t : rounds) values.push_back(value(t));
        return median(values);
    }
    [[nodiscard]] double polygon() const {
        return of([](const Times& t) { return t.polygon; });
    }
    [[nodiscard]] double exactRays() const {
        return of([](const Times& t) { return t.rays; });
    }
};

Measured measure(int triangles, const Settings& settings) {
    const Snapshot snapshot = bumpyScene(triangles);
    auto start = std::chrono::steady_clock::now();
    const PrimaryHits ground =
        groundOnly(ExactScene(snapshot, settings.threads).primaryHits({settings.size, settings.size}));
    Measured result{static_cast<int>(snapshot.triangles()), 0, secondsSince(start), {}, 0, 0, 0, 0};

    Image<float> embree;
    Reference polygon, rays;
    for (int round = 0; round < settings.rounds; ++round) {
        Times t{};
        start = std::chrono::steady_clock::now();
        {
            const EmbreeShadows scene(snapshot, settings.threads);
            t.embreeBuild = secondsSince(start);
            start = std::chrono::steady_clock::now();
            embree = scene.visibility(ground, glm::dvec4(snapshot.light.centre, 1), tnear);
            t.embreeTrace = secondsSince(start);
        }
        start = std::chrono::steady_clock::now();
        polygon = polygonLabels(snapshot, ground, settings, &t.distances);
        t.polygon = secondsSince(start);
        start = std::chrono::steady_clock::now();
        rays = rayLabels(snapshot, ground, settings);
        t.rays = secondsSince(start);
        result.rounds.push_back(t);
    }
    const Image<float> fromZero =
        EmbreeShadows(snapshot, settings.threads).visibility(ground, glm::dvec4(snapshot.light.centre, 1), 0);
    for (std::size_t i = 0; i < ground.id.size(); ++i) {
        if (ground.surface[i] != groundtruth::Surface::Receiver) continue;
        ++result.rays;
        result.shadowed += rays.visibility[i] == 0;
        result.embreeWrong += embree[i] != rays.visibility[i];
        result.embreeWrongFromZero += fromZero[i] != rays.visibility[i];
        result.differing += polygon.visibility[i] != rays.visibility[i] || polygon.surface[i] != rays.surface[i];
    }
    return result;
}

std::string timeTable(const std::vector<Measured>& all) {
    std::string text =
        "| triangles | shadow rays | in shadow | Embree build + trace, ms | polygon, ms (edge distances) | ÷ "
        "Embree | rays, ms "
        "| ÷ Embree | polygon ≠ rays, px | Embree wrong, px (with tnear = 0) |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const Measured& m : all) {
        const double build = m.of([](const Times& t) { return t.embreeBuild; });
        const double trace = m.of([](const Times& t) { return t.embreeTrace; });
        const double distances = m.of([](const Times& t) { return t.distances; });
        text += fmt::format(
            "| {} | {} | {} | {:.1f} + {:.1f} | {:.1f} ({:.1f}) | **{:.2f}** | {:.0f} | **{:.1f}** | {} | {} ({}) |\n",
            m.triangles, m.rays, m.shadowed, 1e3 * build, 1e3 * trace, 1e3 * m.polygon(), 1e3 * distances,
            m.of([](const Times& t) { return t.polygon / t.embree(); }), 1e3 * m.exactRays(),
            m.of([](const Times& t) { return t.rays / t.embree(); }), m.differing, m.embreeWrong, m.embreeWrongFromZero);
    }
    return text;
}

std::string growthText(const std::vector<Measured>& all) {
    std::string text;
    for (std::size_t i = 1; i < all.size(); ++i)
        text += fmt::format("* From {} to {} triangles polygon takes {:.1f} times as long, rays {:.1f} times.\n",
                            all[i - 1].triangles, all[i].triangles, all[i].polygon() / all[i - 1].polygon(),
                            all[i].exactRays() / all[i - 1].exactRays());
    return text;
}

/// Each oracle in a process that does nothing else; the scene itself is included, the primary hits are made by another one.
std::string memoryTable(const Settings& settings) {
    const int triangles = std::ranges::max(settings.triangles);
    const SharedHits shared(settings.size);
    static_cast<void>(peakMemory([&] {
        shared.store(groundOnly(ExactScene(bumpyScene(triangles)).primaryHits({settings.size, settings.size})));
    }));
    const auto mebibytes = [](std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    const std::size_t scene = peakMemory([&] { static_cast<void>(bumpyScene(triangles)); });
    const std::size_t embree = peakMemory([&] {
        const Snapshot snapshot = bumpyScene(triangles);
        static_cast<void>(EmbreeShadows(snapshot, settings.threads)
                              .visibility(shared.load(), glm::dvec4(snapshot.light.centre, 1), tnear));
    });
    const std::size_t polygon =
        peakMemory([&] { static_cast<void>(polygonLabels(bumpyScene(triangles), shared.load(), settings)); });
    const std::size_t rays =
        peakMemory([&] { static_cast<void>(rayLabels(bumpyScene(triangles), shared.load(), settings)); });
    return fmt::format("| peak memory at {} triangles, MiB | the scene alone | with Embree | with polygon | with rays |\n"
                       "|---|--:|--:|--:|--:|\n| | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n",
                       triangles, mebibytes(scene), mebibytes(embree), mebibytes(polygon), mebibytes(rays));
}

std::string report(const Settings& settings) {
    const std::string memory = memoryTable(settings); // first, while this process is small
    std::vector<Measured> all;
    for (const int triangles : settings.triangles) all.push_back(measure(triangles, settings));
    std::string text = fmt::format("# What exact shadows cost\n\nMade by `oracles`: a bumpy body over a planar ground, {0}² "
                                   "pixels, {1} thread{3}, medians of {2} "
                                   "interleaved rounds.\nAll start from the same primary hits (",
                                   settings.size, settings.threads, settings.rounds, settings.threads == 1 ? "" : "s");
    for (const Measured& m : all) text += fmt::format("{}{:.1f} s", &m == all.data() ? "" : ", ", m.primary);
    text += " with their tree, not included) and label the ground's pixels.\n\n"
            "* Embree 3: copying the vertices, building (default quality, robust), one `rtcOccluded1` for each pixel, in "
            "float, from "
            "1e-4 of the way on.\n"
            "* polygon: from the snapshot to labels, certified, and distances to the nearest shadow edge (their share in "
            "brackets). "
            "No tree is built.\n"
            "* rays: from the snapshot to labels, the tree included.\n\n";
    text += timeTable(all) + "\n" + growthText(all) + "\n" + memory;
    return text;
}

/// Seconds of one scene, and where Embree and the exact truth differ.
struct SceneTimes {
    std::string id;
    std::size_t triangles = 0, receivers = 0, wrong = 0;
    double primary = 0, build = 0, trace = 0, labels = 0;
    double lightTrace = 0, area = 0, areaRms = 0; // 0 where no area shares are compared
};

constexpr double surfaceOffset = 1e-3; // metres from the surface at which Embree's rays begin

/// The mean of Embree's visibility over a grid of points of the light.
Image<float> lightMean(const EmbreeShadows& scene, const PrimaryHits& primary, const Light& light, int side, float from) {
    Image<float> sum(primary.id.width(), primary.id.height());
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 at((i % side + 0.5) / side, (i / side + 0.5) / side);
        const Image<float> one = scene.visibility(primary, glm::dvec4(light.sample(at), 1), from);
        for (std::size_t pixel = 0; pixel < sum.size(); ++pixel) sum[pixel] += one[pixel] / static_cast<float>(side * side);
    }
    return sum;
}

SceneTimes measureScene(const std::string& id, const Settings& settings) {
    const Scene scene = loadScene(id, profileNamed(settings.profile));
    const Snapshot shown = snapshot(scene, scene.timeline.still - 1);
    const Bounds bounds = shown.bounds();
    const auto from = static_cast<float>(surfaceOffset / glm::length(bounds.high - bounds.low));
    SceneTimes times{.id = scene.id, .triangles = shown.triangles()};
    auto start = std::chrono::steady_clock::now();
    const auto lap = [&](double& seconds) {
        seconds = secondsSince(start);
        start = std::chrono::steady_clock::now();
    };
    Snapshot centre = shown; // what has a label faces the centre
    centre.light = shown.light.centreOnly();
    const PrimaryHits primary = groundtruth::hard::primaryHits(centre, scene.size);
    lap(times.primary);
    const EmbreeShadows embree(shown, availableThreads());
    lap(times.build);
    const Image<float> traced = embree.visibility(primary, centre.light.homogeneous(), from);
    lap(times.trace);
    const Reference exact = compute(groundtruth::Request(shown, scene.size, groundtruth::Truth::Hard));
    lap(times.labels);
    for (std::size_t i = 0; i < traced.size(); ++i) {
        if (exact.surface[i] != groundtruth::Surface::Receiver) continue;
        ++times.receivers;
        times.wrong += traced[i] != exact.visibility[i];
    }
    if (!shown.light.isArea() || settings.lightRays == 0) return times;
    const PrimaryHits facing = groundtruth::hard::primaryHits(shown, scene.size); // what has a share faces all of the light
    start = std::chrono::steady_clock::now();
    const int side = static_cast<int>(std::lround(std::sqrt(settings.lightRays)));
    const Image<float> mean = lightMean(embree, facing, shown.light, side, from);
    lap(times.lightTrace);
    const Reference area = compute(groundtruth::Request(shown, scene.size, groundtruth::Truth::Area));
    lap(times.area);
    double squares = 0;
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        if (area.surface[i] != groundtruth::Surface::Receiver) continue;
        ++receivers;
        squares += (mean[i] - area.visibility[i]) * (mean[i] - area.visibility[i]);
    }
    times.areaRms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(receivers, 1)));
    return times;
}

std::string scenesReport(const Settings& settings) {
    std::string text = fmt::format(
        "# What exact shadows cost on scenes\n\n"
        "Made by `oracles --scene {} --profile {} --light-rays {}`, {} threads. Embree 3 traces one ray to the light's\n"
        "centre, and as many to points of an area light as `--light-rays` says, from {:g} m off the surface, and starts "
        "from\n"
        "the exact primary hits; labels and area shares are what a run computes, from the snapshot on, primary hits "
        "included.\n\n"
        "| scene | triangles | receivers | primary hits, s | Embree build + trace, s | labels, s | ÷ Embree | Embree wrong, "
        "px "
        "| Embree's light rays, s | area shares, s | ÷ Embree | rms apart "
        "|\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        fmt::join(settings.scenes, ","), settings.profile, settings.lightRays, availableThreads(), surfaceOffset);
    for (const std::string& id : settings.scenes) {
        const SceneTimes t = measureScene(id, settings);
        text += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} + {:.2f} | {:.2f} | **{:.2f}** | {} |", t.id, t.triangles,
                            t.receivers, t.primary, t.build, t.trace, t.labels, t.labels / (t.build + t.trace), t.wrong);
        text += t.area == 0 ? std::string(" – | – | – | – |\n")
                            : fmt::format(" {:.1f} | {:.1f} | **{:.2f}** | {:.4f} |\n", t.lightTrace, t.area,
                                          t.area / (t.build + t.lightTrace), t.areaRms);
    }
    return text;
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App app("The exact oracles against Embree");
    app.add_option("--triangles", settings.triangles, "of the body, one size after another")->delimiter(',');
    app.add_option("--size", settings.size, "pixels on a side")->check(CLI::Range(16, 4096));
    app.add_option("--rounds", settings.rounds)->check(CLI::Range(1, 1000));
    app.add_option("--threads", settings.threads)->check(CLI::Range(1, 256));
    app.add_option("--scene", settings.scenes, "scenes of the library, or files, instead of the bumpy body")->delimiter(',');
    app.add_option("--profile", settings.profile, "of the scenes")->capture_default_str();
    app.add_option("--light-rays", settings.lightRays,
                   "a pixel that Embree traces to an area light; 0 compares no area shares")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--out", settings.out, "file for the tables");
    CLI11_PARSE(app, argc, argv);
    const std::string text = settings.scenes.empty() ? report(settings) : scenesReport(settings);
    fmt::print("{}", text);
    if (!settings.out.empty()) writeFile(settings.out, text);
    return 0;
}

} // namespace
} // namespace shadowbench::benchmarks

int main(int argc, char** argv) {
    try {
        return shadowbench::benchmarks::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
