// Structural similarity, Z. Wang et al., "Image quality assessment: from error visibility to structural similarity", 2004.
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowbench::metrics {
namespace {

constexpr int radius = 5;
constexpr int side = 2 * radius + 1;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01; // (K L)², L = 1
constexpr double c2 = 0.03 * 0.03;

std::array<double, side> gaussian() {
    std::array<double, side> weights{};
    for (int i = 0; i < side; ++i) weights[i] = std::exp(-0.5 * (i - radius) * (i - radius) / (sigma * sigma));
    return weights;
}

/// Weighted first and second moments of two images over one window.
struct Moments {
    double weight = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    void add(double w, double vx, double vy) {
        weight += w;
        x += w * vx;
        y += w * vy;
        xx += w * vx * vx;
        yy += w * vy * vy;
        xy += w * vx * vy;
    }
    [[nodiscard]] double similarity() const { // eq. 13
        const double mx = x / weight;
        const double my = y / weight;
        const double varianceX = xx / weight - mx * mx;
        const double varianceY = yy / weight - my * my;
        const double covariance = xy / weight - mx * my;
        return (2 * mx * my + c1) * (2 * covariance + c2) / ((mx * mx + my * my + c1) * (varianceX + varianceY + c2));
    }
};

} // namespace

std::optional<double> ssim(const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    if (mask.count == 0) return {};
    const std::array<double, side> weights = gaussian();
    double sum = 0;
    for (int y = 0; y < v.height(); ++y) {
        for (int x = 0; x < v.width(); ++x) {
            if (!mask.scored(x, y)) continue;
            Moments window;
            for (int ny = std::max(0, y - radius); ny <= std::min(v.height() - 1, y + radius); ++ny)
                for (int nx = std::max(0, x - radius); nx <= std::min(v.width() - 1, x + radius); ++nx)
                    if (mask.scored(nx, ny))
                        window.add(weights[nx - x + radius] * weights[ny - y + radius], v(nx, ny), truth.visibility(nx, ny));
            sum += window.similarity();
        }
    }
    return sum / static_cast<double>(mask.count);
}

} // namespace shadowbench::metrics
