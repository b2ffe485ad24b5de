// Exact shares of area lights (by area, irradiance and solid angle) against random points of the lights, on scenes of the
// library with rectangles, and with disks of the same sides until there are twenty.
//
//   build/release/benchmarks/light_shares [--points 1000] [--samples 65536] [--scene simple] [--images]
//
// The points of the lights are seen or not by Embree, whose rays start in single precision at the exact surface points;
// triangles whose plane contains the surface point are ignored, as they are by the exact oracles. Ends with 1 where more
// than 6 of the 20,000 shares of a kind are further than 4 σ from what the samples say, or one further than 6 σ.
#include "base/error.h"
#include "base/parallel.h"
#include "benchmarks/embree_shadows.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/exact.h"
#include "scene/load/load.h"
#include "tests/support/share_samples.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <unordered_map>

namespace shadowbench::groundtruth {
namespace {

struct Options {
    std::vector<std::string> scenes;
    int points = 1000, samples = 65536;
    bool images = false;
};

constexpr int wantedScenes = 20;
constexpr std::array shareNames{"area", "irradiance", "solid-angle"};

struct Named {
    std::string name;
    Snapshot snapshot;
    glm::ivec2 size;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The scored frames of the scenes with rectangles, then those of the first ones with disks.
std::vector<Named> namedScenes(const std::vector<std::string>& chosen) {
    std::vector<Named> found;
    for (const std::string& id : chosen.empty() ? builtinScenes() : chosen) {
        const Scene scene = loadScene(id, Profile::Gate);
        if (scene.light.kind == LightKind::Rectangle || scene.light.kind == LightKind::Disk)
            found.push_back({scene.id, snapshot(scene, scene.timeline.still - 1), scene.size});
    }
    const std::size_t rectangles = found.size();
    for (std::size_t i = 0; chosen.empty() && i < rectangles && found.size() < wantedScenes; ++i) {
        found.push_back(found[i]);
        found.back().name += " (disk)";
        found.back().snapshot.light.kind = LightKind::Disk;
    }
    return found;
}

/// A pixel, what it sees, and the middle of each share's bracket.
struct Compared {
    glm::ivec2 pixel;
    std::array<double, 3> exact{};
    std::array<int, 3> visible{};
};

/// What is prepared of a scene.
class Comparison {
public:
    explicit Comparison(const Named& named)
        : snapshot_(named.snapshot), size_(named.size),
          triangles_(std::make_shared<const geometry::SceneTriangles>(snapshot_)),
          primary_(hard::ExactScene(snapshot_, triangles_, availableThreads()).primaryHits(size_)),
          exact_(snapshot_, triangles_, availableThreads()), rays_(snapshot_, availableThreads(), true) {}

    /// Three quarters of them where the light is partly visible, as far as 20 times as many pixels hold that many.
    [[nodiscard]] std::vector<Compared> chosen(int count) const {
        std::vector<Compared> partly, others;
        const auto wanted = static_cast<std::size_t>(count), wantedPartly = 3 * wanted / 4;
        Random random(static_cast<std::uint64_t>(count));
        for (int i = 0; i < 20 * count; ++i) {
            if (partly.size() >= wantedPartly && partly.size() + others.size() >= wanted) break;
            const glm::ivec2 pixel(static_cast<int>(random.uniform() * size_.x),
                                   static_cast<int>(random.uniform() * size_.y));
            if (primary_.surface(pixel.x, pixel.y) != Surface::Receiver) continue;
            const Compared found = at(pixel);
            const bool whole = found.exact[0] == 0 || found.exact[0] == 1;
            (whole ? others : partly).push_back(found);
        }
        others.resize(std::min(others.size(), wanted - std::min(partly.size(), wanted)));
        partly.insert(partly.end(), others.begin(), others.end());
        return partly;
    }

    void sample(Compared& compared, int samples) const {
        const glm::ivec2 pixel = compared.pixel;
        const geometry::TriangleName own{triangles_->instanceOf(primary_.id(pixel.x, pixel.y)),
                                         primary_.triangle(pixel.x, pixel.y)};
        const geometry::Triangle receiver = triangles_->triangle(own);
        const geometry::ReceiverPoint point(geometry::pixelRay(snapshot_.camera, pixel.x, pixel.y, size_), receiver);
        glm::dvec3 normal = glm::normalize(glm::cross(receiver[1] - receiver[0], receiver[2] - receiver[0]));
        if (glm::dot(normal, snapshot_.light.centre - receiver[0]) < 0) normal = -normal;

        std::unordered_map<std::uint64_t, bool> known;
        const auto ignored = [&](unsigned instance, unsigned triangle) {
            const auto [entry, isNew] = known.try_emplace(std::uint64_t{instance} << 32U | triangle, false);
            if (isNew) entry->second = geometry::side(triangles_->triangle({instance, triangle}), point) == 0;
            return entry->second;
        };
        const ShareSampler sampler(snapshot_.light, point.rounded(), normal);
        const auto seed = static_cast<std::uint64_t>(pixel.y) << 32U | static_cast<std::uint64_t>(pixel.x);
        compared.visible =
            sampler.visibleOf(samples, seed, [&](const std::vector<glm::dvec3>& lights, std::vector<char>& seen) {
                rays_.visible(point.rounded(), lights, ignored, seen);
            });
    }

    /// Seconds of the processor, of all threads, that the whole image takes by each share.
    [[nodiscard]] std::array<double, 3> imageSeconds() const {
        std::array<double, 3> seconds{};
        for (std::size_t i = 0; i < 3; ++i) {
            Reference out;
            const std::clock_t start = std::clock();
            exact_.label(size_, primary_, out, {}, sampledShares[i]);
            seconds[i] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        }
        return seconds;
    }

private:
    [[nodiscard]] Compared at(glm::ivec2 pixel) const {
        Compared result{pixel};
        for (std::size_t i = 0; i < 3; ++i) {
            const area::VisibleFraction f = exact_.fraction(pixel, size_, primary_, sampledShares[i]);
            result.exact[i] = 0.5 * (f.low + f.high);
        }
        return result;
    }

    const Snapshot& snapshot_;
    glm::ivec2 size_;
    std::shared_ptr<const geometry::SceneTriangles> triangles_;
    PrimaryHits primary_;
    area::AreaScene exact_;
    benchmarks::EmbreeShadows rays_;
};

/// Of all points so far: by share, how many are beyond 4 σ and 6 σ, and the furthest.
struct Beyond {
    int four = 0, six = 0;
    double most = 0;

    void add(double deviation) {
        four += deviation > 4 ? 1 : 0;
        six += deviation > 6 ? 1 : 0;
        most = std::max(most, deviation);
    }
};

void compare(const Named& named, const Options& options, std::array<Beyond, 3>& all) {
    const auto start = std::chrono::steady_clock::now();
    const Comparison comparison(named);
    std::vector<Compared> points = comparison.chosen(options.points);
    inParallel(static_cast<int>(points.size()), availableThreads(),
               [&](int i) { comparison.sample(points[static_cast<std::size_t>(i)], options.samples); });
    std::array<Beyond, 3> here;
    double apart = 0;
    int partly = 0;
    for (const Compared& point : points) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double found = static_cast<double>(point.visible[i]) / options.samples, exact = point.exact[i];
            const double deviation = std::abs(found - exact) / sampledSigma(exact, options.samples);
            here[i].add(deviation);
            all[i].add(deviation);
        }
        apart = std::max(apart, std::ranges::max(point.exact) - std::ranges::min(point.exact));
        partly += point.exact[0] > 0 && point.exact[0] < 1 ? 1 : 0;
    }
    fmt::print("{:<30} {:>5} points, {:>4} partly lit; shares differ by up to {:.4f};", named.name, points.size(), partly,
               apart);
    for (std::size_t i = 0; i < 3; ++i)
        fmt::print(" {} {} > 4 σ, {} > 6 σ, at most {:.2f} σ;", shareNames[i], here[i].four, here[i].six, here[i].most);
    fmt::print(" {:.1f} s\n", secondsSince(start));
    std::fflush(stdout);
}

void timeImages(const Named& named) {
    const std::array<double, 3> seconds = Comparison(named).imageSeconds();
    fmt::print("{:<30} {} × {}:", named.name, named.size.x, named.size.y);
    for (std::size_t i = 0; i < 3; ++i) fmt::print(" {} {:.2f} s;", shareNames[i], seconds[i]);
    fmt::print(" of the processor\n");
    std::fflush(stdout);
}

int run(const Options& options) {
    std::array<Beyond, 3> all;
    for (const Named& named : namedScenes(options.scenes))
        if (options.images)
            timeImages(named);
        else
            compare(named, options, all);
    bool good = true;
    for (std::size_t i = 0; !options.images && i < 3; ++i) {
        fmt::print("{}: {} beyond 4 σ, {} beyond 6 σ, at most {:.2f} σ\n", shareNames[i], all[i].four, all[i].six,
                   all[i].most);
        good = good && all[i].four <= 6 && all[i].six == 0;
    }
    return good ? 0 : 1;
}

} // namespace
} // namespace shadowbench::groundtruth

int main(int argc, char** argv) {
    using namespace shadowbench;
    groundtruth::Options options;
    CLI::App app("Exact shares of area lights against random points of them");
    app.add_option("--scene", options.scenes, "Scene ids or files with area lights (default: twenty)");
    app.add_option("--points", options.points, "Surface points of each scene")->capture_default_str();
    app.add_option("--samples", options.samples, "Light points of each surface point")->capture_default_str();
    app.add_flag("--images", options.images, "How long whole images take by each share, instead");
    CLI11_PARSE(app, argc, argv);
    try {
        return groundtruth::run(options);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
