#include "groundtruth/certify/certificate.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "groundtruth/povray/uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace shadowbench::groundtruth {
namespace {

constexpr int fewestPenumbraPoints = 32; // the rms of 32 is known to an eighth
constexpr double widestBracket = 0.01;   // beyond: a point that sees the light edge-on
constexpr double mostReplayed = 0.25;    // samples: POV-Ray's rounding moves an edge over one sample of some thousands

/// Place of a pixel on the Z-order curve: neighbours on it are mostly neighbours in the image.
std::uint64_t curvePlace(glm::ivec2 pixel) {
    std::uint64_t place = 0;
    for (unsigned bit = 0; bit < 16; ++bit) {
        place |= static_cast<std::uint64_t>((static_cast<unsigned>(pixel.x) >> bit) & 1U) << (2 * bit);
        place |= static_cast<std::uint64_t>((static_cast<unsigned>(pixel.y) >> bit) & 1U) << (2 * bit + 1);
    }
    return place;
}

enum Kind : std::size_t { Unresolved, Lit, Umbra, kindCount };
using Kinds = std::array<std::vector<glm::ivec2>, kindCount>;

Kinds pixelsOfEachKind(const povray::Render& image, const PrimaryHits& primary) {
    const Image<std::uint8_t> unresolved = povray::unresolvedPixels(image.visible, primary.id);
    Kinds kinds;
    for (int y = 0; y < primary.surface.height(); ++y) {
        for (int x = 0; x < primary.surface.width(); ++x) {
            if (primary.surface(x, y) != Surface::Receiver || image.hit(x, y) == 0) continue;
            const Kind kind = unresolved(x, y) != 0 ? Unresolved : image.visible(x, y) == 1 ? Lit : Umbra;
            kinds[kind].emplace_back(x, y);
        }
    }
    for (std::vector<glm::ivec2>& pixels : kinds) std::ranges::sort(pixels, {}, curvePlace);
    return kinds;
}

/// How many pixels each kind gives.
std::array<std::size_t, kindCount> shares(const Kinds& kinds, std::size_t points) {
    const std::array<std::size_t, kindCount> wanted{points - 2 * (points / 8), points / 8, points / 8};
    std::array<std::size_t, kindCount> result{};
    for (std::size_t kind = 0; kind < kindCount; ++kind) result[kind] = std::min(wanted[kind], kinds[kind].size());
    std::size_t left = points - std::reduce(result.begin(), result.end());
    for (std::size_t kind = 0; kind < kindCount; ++kind) {
        const std::size_t more = std::min(left, kinds[kind].size() - result[kind]);
        result[kind] += more;
        left -= more;
    }
    return result;
}

double square(double value) { return value * value; }

bool isPartial(double visible) { return visible > 0 && visible < 1; }

double distance(double value, const area::VisibleFraction& exact) {
    return std::max({0.0, value - exact.high, exact.low - value});
}

/// Sums over the points, divided at the end.
class Tally {
public:
    Tally(const povray::Render& image, const Image<float>& sigma, int samples)
        : image_(image), sigma_(sigma), samples_(samples) {}

    /// Whether the point is one of the penumbra.
    bool add(glm::ivec2 pixel, const area::VisibleFraction& exact) {
        if (!(exact.high - exact.low <= widestBracket)) return false;
        ++sums_.points;
        sums_.bracket = std::max(sums_.bracket, (exact.high - exact.low) / 2);
        const double visible = image_.visible(pixel.x, pixel.y);
        sums_.uneven = std::max(sums_.uneven, std::abs(samples_ * visible - std::rint(samples_ * visible)));
        if (!isPartial(visible) && distance(visible, exact) > resolvedTolerance(samples_)) ++sums_.wrong;
        const bool penumbra = isPartial(visible) || distance(visible, exact) > 0;
        if (penumbra) addPenumbra(pixel, (exact.low + exact.high) / 2);
        return penumbra;
    }

    /// Of the samples that the render says that it has, so many are visible from a point of the penumbra.
    void addReplay(glm::ivec2 pixel, int visible) {
        sums_.replayed += std::abs(samples_ * static_cast<double>(image_.visible(pixel.x, pixel.y)) - visible);
    }

    [[nodiscard]] Certificate result() const {
        Certificate mean = sums_;
        if (mean.penumbra == 0) return mean;
        mean.bias /= mean.penumbra;
        mean.replayed /= mean.penumbra;
        for (double* squares : {&mean.rms, &mean.rmsHalf, &mean.rmsQuarter, &mean.independent, &mean.sigma})
            *squares = std::sqrt(*squares / mean.penumbra);
        return mean;
    }

private:
    void addPenumbra(glm::ivec2 pixel, double truth) {
        const double error = image_.visible(pixel.x, pixel.y) - truth;
        ++sums_.penumbra;
        sums_.bias += error;
        sums_.rms += square(error);
        sums_.largest = std::max(sums_.largest, std::abs(error));
        sums_.rmsHalf += square(image_.firstHalf(pixel.x, pixel.y) - truth);
        sums_.rmsQuarter += square(image_.firstQuarter(pixel.x, pixel.y) - truth);
        sums_.independent += truth * (1 - truth) / samples_;
        sums_.sigma += square(sigma_(pixel.x, pixel.y));
    }

    const povray::Render& image_;
    const Image<float>& sigma_;
    int samples_;
    Certificate sums_;
};

/// What `ask(pixel)` answers at each pixel, in their order.
template <typename Answer, typename Ask>
std::vector<Answer> atEach(const std::vector<glm::ivec2>& pixels, int threads, const Progress& progress, const Ask& ask) {
    std::vector<Answer> answers(pixels.size());
    inParallel(static_cast<int>(pixels.size()), threads, progress, "certificate", [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        answers[index] = ask(pixels[index]);
    });
    return answers;
}

[[noreturn]] void rejectRender(std::string_view what) {
    throw Inconclusive(
        fmt::format("POV-Ray's shadows were compared with the exact visible fraction and rejected: {}; ask for "
                    "more samples, and report this scene if that does not help",
                    what));
}

} // namespace

std::vector<glm::ivec2> certificatePoints(const povray::Render& image, const PrimaryHits& primary, int points) {
    const Kinds kinds = pixelsOfEachKind(image, primary);
    const std::array<std::size_t, kindCount> counts = shares(kinds, static_cast<std::size_t>(std::max(points, 0)));
    Random random(0);
    std::vector<glm::ivec2> result;
    for (std::size_t kind = 0; kind < kindCount; ++kind) {
        const double part = static_cast<double>(kinds[kind].size()) / static_cast<double>(counts[kind]);
        for (std::size_t i = 0; i < counts[kind]; ++i) {
            const double place = (static_cast<double>(i) + random.uniform()) * part;
            result.push_back(kinds[kind][std::min(static_cast<std::size_t>(place), kinds[kind].size() - 1)]);
        }
    }
    return result;
}

Certificate certify(const povray::Render& image, const PrimaryHits& primary, int samples, int points, int threads,
                    const ExactFraction& exact, const Progress& progress) {
    const std::vector<glm::ivec2> pixels = certificatePoints(image, primary, points);
    const std::vector<area::VisibleFraction> fractions = atEach<area::VisibleFraction>(pixels, threads, progress, exact);
    const Image<float> sigma = povray::samplingUncertainty(image, primary.id, samples);
    Tally tally(image, sigma, samples);
    for (std::size_t i = 0; i < pixels.size(); ++i) tally.add(pixels[i], fractions[i]);
    return tally.result();
}

Certificate certify(const Request& request, const povray::Render& image, const PrimaryHits& primary, int points, int threads,
                    const Progress& progress) {
    return certify(area::AreaScene(request.snapshot, threads), request, image, primary, points, threads, progress);
}

Certificate certify(const area::AreaScene& scene, const Request& request, const povray::Render& image,
                    const PrimaryHits& primary, int points, int threads, const Progress& progress, std::uint32_t set) {
    const std::vector<glm::ivec2> pixels = certificatePoints(image, primary, points);
    HonestRenders honest(request.snapshot.light.kind, request.samples, set);
    const auto exact = atEach<area::SampledFraction>(pixels, threads, progress, [&](glm::ivec2 pixel) {
        return scene.sampledFraction(pixel, request.size, primary, honest.points());
    });
    const Image<float> sigma = povray::samplingUncertainty(image, primary.id, request.samples);
    Tally tally(image, sigma, request.samples);
    int partlyLit = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto& [fraction, visible] = exact[i];
        if (!tally.add(pixels[i], fraction)) continue;
        tally.addReplay(pixels[i], visible.front());
        const double truth = (fraction.low + fraction.high) / 2;
        if (!isPartial(truth)) continue;
        honest.add(truth, visible);
        ++partlyLit;
    }
    Certificate certificate = tally.result();
    if (partlyLit >= fewestPenumbraPoints) certificate.honest = honest.bounds();
    return certificate;
}

double resolvedTolerance(int samples) { return std::min(0.9, 4 * std::pow(samples, -0.75)); }

void requireCertified(const Certificate& c, int samples) {
    if (c.wrong > 0)
        rejectRender(fmt::format("{} of {} points are fully lit or fully shadowed and should not be", c.wrong, c.points));
    if (c.uneven > 0.25)
        rejectRender(fmt::format("a pixel sees no whole number of the {} samples, so their weights are not equal", samples));
    if (c.replayed > mostReplayed)
        rejectRender(
            fmt::format("its values differ by {:.2f} of {} samples on average from what these samples see: the light, the "
                        "samples or the geometry are not those of the scene",
                        c.replayed, samples));
    if (!c.honest) return;

    const double replay = mostReplayed / samples;
    if (std::abs(c.bias) > c.honest->bias + replay)
        rejectRender(fmt::format(
            "its mean error of {:+.5f} over {} penumbra points is none of sampling: other sets of {} samples err "
            "by {:.5f} at most",
            c.bias, c.penumbra, samples, c.honest->bias));
    if (c.rms > c.honest->rms + replay)
        rejectRender(
            fmt::format("its rms error of {:.5f} over {} penumbra points is more than other sets of {} samples leave, which "
                        "is {:.5f} at most",
                        c.rms, c.penumbra, samples, c.honest->rms));
    if (c.rms > c.honest->fall * c.rmsQuarter + replay)
        rejectRender(
            fmt::format("its rms error does not fall with the number of samples: {:.5f} with a quarter of them, {:.5f} with "
                        "all {}, where other sets fall to {:.2f} times at least",
                        c.rmsQuarter, c.rms, samples, c.honest->fall));
}

Image<float> calibrated(Image<float> sigma, const Certificate& certificate, int samples) {
    const double rounding = 1 / (samples * std::sqrt(12.0));
    const bool known = certificate.penumbra >= fewestPenumbraPoints && certificate.sigma > 0;
    const double scale = known ? certificate.rms / certificate.sigma : 1;
    for (float& value : sigma)
        if (value > 0) value = static_cast<float>(std::max(scale * value, rounding));
    return sigma;
}

std::map<std::string, double> measured(const Certificate& c) {
    std::map<std::string, double> values{{"certificate_points", c.points},
                                         {"certificate_penumbra", c.penumbra},
                                         {"certificate_wrong", c.wrong},
                                         {"certificate_bias", c.bias},
                                         {"certificate_rms", c.rms},
                                         {"certificate_largest", c.largest},
                                         {"certificate_rms_half", c.rmsHalf},
                                         {"certificate_rms_quarter", c.rmsQuarter},
                                         {"certificate_independent", c.independent},
                                         {"certificate_uneven", c.uneven},
                                         {"certificate_bracket", c.bracket},
                                         {"certificate_replayed", c.replayed}};
    if (c.honest)
        values.insert({{"certificate_most_bias", c.honest->bias},
                       {"certificate_most_rms", c.honest->rms},
                       {"certificate_most_fall", c.honest->fall}});
    return values;
}

} // namespace shadowbench::groundtruth
