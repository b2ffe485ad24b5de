#include "groundtruth/certify/pixel_certificate.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

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

[[noreturn]] void reject(const std::string& what) {
    throw Inconclusive(
        fmt::format("pixel areas were compared with exact rays and rejected: {}; please report this scene", what));
}

} // namespace

PixelCertificate certifyPixels(const hard::ExactScene& scene, const Reference& means, const Reference& labels, int points,
                               int threads, const Progress& progress) {
    const std::vector<glm::ivec2> pixels = chosen(means, points);
    const glm::ivec2 size(means.visibility.width(), means.visibility.height());
    struct Compared {
        double error = 0, variance = 0;
    };
    std::vector<Compared> found(pixels.size());
    inParallel(static_cast<int>(pixels.size()), threads, progress, "certificate", [&](int i) {
        const glm::ivec2 pixel = pixels[static_cast<std::size_t>(i)];
        const auto [mean, sigma] = scene.meanByRays(size, pixel, means.id(pixel.x, pixel.y), pixelCertificateRays);
        found[static_cast<std::size_t>(i)] = {means.visibility(pixel.x, pixel.y) - mean, sigma * sigma};
    });

    PixelCertificate result;
    result.points = static_cast<int>(pixels.size());
    result.contradicting = contradicting(means, labels);
    if (found.empty()) return result;
    double variance = 0, squares = 0;
    for (const Compared& one : found) {
        result.bias += one.error / static_cast<double>(found.size());
        squares += one.error * one.error;
        variance += one.variance;
        result.largest = std::max(result.largest, std::abs(one.error));
    }
    result.rms = std::sqrt(squares / static_cast<double>(found.size()));
    result.independent = std::sqrt(variance / static_cast<double>(found.size()));
    return result;
}

void requirePixelsCertified(const PixelCertificate& c) {
    constexpr int enough = 32; // points
    if (c.contradicting > 0)
        reject(fmt::format("{} pixels are fully lit or shadowed against their exact label", c.contradicting));
    if (c.rms > 0.75 * c.independent)
        reject(fmt::format("the rms error over {} pixels is {:.4f}, more than 0.75 times the {:.4f} of independent rays",
                           c.points, c.rms, c.independent));
    if (c.points >= enough && std::abs(c.bias) > 0.3 * c.independent)
        reject(fmt::format("the mean error over {} pixels is {:.4f}, more than 0.3 times the {:.4f} of independent rays",
                           c.points, c.bias, c.independent));
}

std::map<std::string, double> measured(const PixelCertificate& c) {
    return {{"certificate_points", c.points},   {"certificate_contradicting", c.contradicting},
            {"certificate_bias", c.bias},       {"certificate_rms", c.rms},
            {"certificate_largest", c.largest}, {"certificate_independent", c.independent}};
}

} // namespace shadowbench::groundtruth
