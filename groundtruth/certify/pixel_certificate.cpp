#include "groundtruth/certify/pixel_certificate.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

constexpr double widestArea = 5; // of σ* that an area's own estimate may be off by

bool isPartlyLit(float visibility) { return visibility > 0 && visibility < 1; }

/// Receivers that are partly lit, or all others, row by row.
std::vector<glm::ivec2> receivers(const Reference& means, bool partlyLit) {
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < means.visibility.height(); ++y)
        for (int x = 0; x < means.visibility.width(); ++x)
            if (means.surface(x, y) == Surface::Receiver && isPartlyLit(means.visibility(x, y)) == partlyLit)
                pixels.push_back({x, y});
    return pixels;
}

/// `count` of them, evenly spread over their order; all if there are fewer.
void addSpread(const std::vector<glm::ivec2>& pixels, std::size_t count, std::vector<glm::ivec2>& points) {
    const std::size_t taken = std::min(count, pixels.size());
    for (std::size_t i = 0; i < taken; ++i) points.push_back(pixels[(2 * i + 1) * pixels.size() / (2 * taken)]);
}

std::vector<glm::ivec2> chosen(const Reference& means, int points) {
    const auto all = static_cast<std::size_t>(points);
    const std::vector<glm::ivec2> partly = receivers(means, true), fully = receivers(means, false);
    std::vector<glm::ivec2> result;
    addSpread(partly, std::max(3 * all / 4, all - std::min(all, fully.size())), result);
    addSpread(fully, all - result.size(), result);
    return result;
}

int contradicting(const Reference& means, const Reference& labels) {
    int count = 0;
    for (std::size_t i = 0; i < means.visibility.size(); ++i) {
        const bool compared = labels.surface[i] == Surface::Receiver && !isPartlyLit(means.visibility[i]);
        if (compared && means.visibility[i] != labels.visibility[i]) ++count;
    }
    return count;
}

/// What the rays of a point say of it.
struct Compared {
    double error = 0;       // of the area against the mean of the sets
    double variance = 0;    // that the error has if the area is right
    double independent = 0; // the same if the rays were independent
    double seenShare = 0;   // of the pixel: its surface's
    bool seen = false;      // by the rays of every set
    bool impossible = false;
};

/// How far the mean of `rays` independent draws of probability `share` may lie from it. Bernstein's inequality; draws that
/// are spread over the cells of a grid lie nearer.
double furthestMean(double share, double rays) {
    constexpr double exceeded = 1e-5 / pixelCertificatePoints; // by chance
    const double log = std::log(2 / exceeded);
    return std::sqrt(2 * share * (1 - share) * log / rays) + 2 * log / (3 * rays);
}

Compared compared(const hard::ExactScene& scene, const Reference& means, glm::ivec2 pixel, std::uint16_t firstSet) {
    const glm::ivec2 size(means.visibility.width(), means.visibility.height());
    std::array<hard::ExactScene::PixelMean, pixelCertificateSets> sets;
    for (std::size_t set = 0; set < sets.size(); ++set)
        sets[set] = scene.meanByRays(size, pixel, means.id(pixel.x, pixel.y), pixelCertificateRays,
                                     static_cast<std::uint16_t>(firstSet + set));
    Compared result;
    if (std::ranges::any_of(sets, [](const auto& set) { return set.seen <= 0; })) return result;
    result.seen = true;
    constexpr double count = pixelCertificateSets;
    double mean = 0, squares = 0;
    for (const auto& set : sets) mean += set.mean / count;
    for (const auto& set : sets) {
        squares += (set.mean - mean) * (set.mean - mean);
        result.seenShare += set.seen / count;
    }
    const double rays = result.seenShare * count * pixelCertificateRays * pixelCertificateRays;
    const double area = means.visibility(pixel.x, pixel.y), sigma = means.sigma(pixel.x, pixel.y);
    result.error = area - mean;
    result.variance = squares / (count * (count - 1)) + sigma * sigma;
    result.independent = area * (1 - area) / rays;
    result.impossible = std::abs(result.error) > furthestMean(area, rays) + widestArea * sigma;
    return result;
}

/// A mean and its standard error.
struct Mean {
    double value = 0, error = 0;
};
template <class Value>
Mean meanOf(const std::vector<Compared>& points, const Value& value) {
    const auto count = static_cast<double>(points.size());
    Mean mean;
    double squares = 0;
    for (const Compared& point : points) mean.value += value(point) / count;
    for (const Compared& point : points) squares += (value(point) - mean.value) * (value(point) - mean.value);
    mean.error = points.size() > 1 ? std::sqrt(squares / (count * (count - 1))) : 0;
    return mean;
}

/// Root of the mean, each point weighed by its surface's share of the pixel: where that is small, a few rays decide.
template <class Value>
double rootMeanOf(const std::vector<Compared>& points, const Value& value) {
    double sum = 0, weights = 0;
    for (const Compared& point : points) {
        sum += point.seenShare * value(point);
        weights += point.seenShare;
    }
    return weights > 0 ? std::sqrt(sum / weights) : 0;
}

[[noreturn]] void rejectAreas(const std::string& what) {
    throw Inconclusive(
        fmt::format("pixel areas were compared with exact rays and rejected: {}; please report this scene", what));
}

} // namespace

PixelCertificate certifyPixels(const hard::ExactScene& scene, const Reference& means, const Reference& labels, int points,
                               int threads, const Progress& progress, std::uint16_t firstSet) {
    const std::vector<glm::ivec2> pixels = chosen(means, points);
    std::vector<Compared> found(pixels.size());
    inParallel(static_cast<int>(pixels.size()), threads, progress, "certificate", [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        found[index] = compared(scene, means, pixels[index], firstSet);
    });
    std::erase_if(found, [](const Compared& point) { return !point.seen; });

    PixelCertificate result;
    result.points = static_cast<int>(found.size());
    result.contradicting = contradicting(means, labels);
    result.impossible = static_cast<int>(std::ranges::count(found, true, &Compared::impossible));
    const Mean bias = meanOf(found, [](const Compared& p) { return p.error; });
    const Mean excess = meanOf(found, [](const Compared& p) { return p.error * p.error - p.variance; });
    result.bias = bias.value;
    result.biasError = bias.error;
    result.excess = excess.value;
    result.excessError = excess.error;
    result.rms = rootMeanOf(found, [](const Compared& p) { return p.error * p.error; });
    result.expected = rootMeanOf(found, [](const Compared& p) { return p.variance; });
    result.independent = rootMeanOf(found, [](const Compared& p) { return p.independent; });
    for (const Compared& point : found) result.largest = std::max(result.largest, std::abs(point.error));
    return result;
}

void requirePixelsCertified(const PixelCertificate& c) {
    constexpr int enough = 32;             // points
    constexpr double standardErrors = 4.5; // a mean of honest errors beyond is one in 100,000
    constexpr double rounding = 1e-6;      // areas are floats
    if (c.contradicting > 0)
        rejectAreas(fmt::format("{} pixels are fully lit or shadowed against their exact label", c.contradicting));
    if (c.impossible > 0)
        rejectAreas(fmt::format("{} of {} pixels are further from their rays than rays can be, by up to {:.4f}",
                                c.impossible, c.points, c.largest));
    // 1.75: three times the mean square, for a few points with few rays can make up most of it.
    if (c.rms > std::max(0.75 * c.independent, 1.75 * c.expected) + rounding)
        rejectAreas(
            fmt::format("the rms error over {} pixels is {:.4f}, more than 0.75 times the {:.4f} of independent rays and "
                        "1.75 times the {:.4f} by which the rays themselves err",
                        c.points, c.rms, c.independent, c.expected));
    if (c.points < enough) return;
    if (std::abs(c.bias) > standardErrors * c.biasError + rounding)
        rejectAreas(fmt::format("the mean error over {} pixels is {:.5f}, more than {} times its standard error, {:.5f}",
                                c.points, c.bias, standardErrors, c.biasError));
    if (c.excess > standardErrors * c.excessError + rounding * rounding)
        rejectAreas(
            fmt::format("the rms error over {} pixels is {:.4f}, beyond what the rays themselves err by on this scene, "
                        "{:.4f}",
                        c.points, c.rms, c.expected));
}

std::map<std::string, double> measured(const PixelCertificate& c) {
    return {{"certificate_points", c.points},
            {"certificate_contradicting", c.contradicting},
            {"certificate_bias", c.bias},
            {"certificate_rms", c.rms},
            {"certificate_largest", c.largest},
            {"certificate_expected", c.expected},
            {"certificate_independent", c.independent},
            {"certificate_impossible", c.impossible},
            {"certificate_bias_error", c.biasError},
            {"certificate_excess", c.excess},
            {"certificate_excess_error", c.excessError}};
}

} // namespace shadowbench::groundtruth
