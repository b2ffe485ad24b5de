// Scores of graded visibility.
#include "base/error.h"
#include "harness/metrics/pixels.h"

#include <cmath>

namespace shadowbench::metrics {
namespace {

constexpr int neighbourhood = 2; // pixels by which the penumbra is dilated and the umbra eroded

struct Errors {
    double squares = 0, absolutes = 0;
};

Errors errors(const Image<float>& v, const groundtruth::Reference& truth, const Image<std::uint8_t>& pixels) {
    Errors sum;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (!pixels[i]) continue;
        const double difference = static_cast<double>(v[i]) - truth.visibility[i];
        sum.squares += difference * difference;
        sum.absolutes += std::abs(difference);
    }
    return sum;
}

std::size_t count(const Image<std::uint8_t>& pixels) {
    std::size_t sum = 0;
    for (const std::uint8_t pixel : pixels) sum += pixel;
    return sum;
}

template <typename Predicate>
Image<std::uint8_t> select(const groundtruth::Reference& truth, const Mask& mask, const Predicate& wanted) {
    Image<std::uint8_t> result(mask.scored.width(), mask.scored.height());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = mask.scored[i] && wanted(truth.visibility[i]) ? 1 : 0;
    return result;
}

/// Calls `visit` with each pixel of the (2r+1)² square around (x, y), inside the image or not.
template <typename Visit>
void forNeighbours(int x, int y, const Visit& visit) {
    for (int dy = -neighbourhood; dy <= neighbourhood; ++dy)
        for (int dx = -neighbourhood; dx <= neighbourhood; ++dx) visit(x + dx, y + dy);
}

Image<std::uint8_t> dilated(const Image<std::uint8_t>& set, const Mask& within) {
    Image<std::uint8_t> result(set.width(), set.height());
    for (int y = 0; y < set.height(); ++y) {
        for (int x = 0; x < set.width(); ++x) {
            if (!set(x, y)) continue;
            forNeighbours(x, y, [&](int nx, int ny) {
                if (result.contains(nx, ny) && within.scored(nx, ny)) result(nx, ny) = 1;
            });
        }
    }
    return result;
}

Image<std::uint8_t> eroded(const Image<std::uint8_t>& set) {
    Image<std::uint8_t> result = set;
    for (int y = 0; y < set.height(); ++y) {
        for (int x = 0; x < set.width(); ++x) {
            forNeighbours(x, y, [&](int nx, int ny) {
                if (!set.contains(nx, ny) || !set(nx, ny)) result(x, y) = 0;
            });
        }
    }
    return result;
}

std::optional<double> penumbraRmse(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    const Image<std::uint8_t> penumbra = select(truth, mask, [](float exact) { return exact > 0 && exact < 1; });
    const Image<std::uint8_t> pixels = dilated(penumbra, mask);
    const std::size_t n = count(pixels);
    if (n == 0) return {};
    return std::sqrt(errors(v, truth, pixels).squares / static_cast<double>(n));
}

std::optional<double> umbraLeak(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    const Image<std::uint8_t> pixels = eroded(select(truth, mask, [](float exact) { return exact == 0; }));
    const std::size_t n = count(pixels);
    if (n == 0) return {};
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (pixels[i]) sum += v[i];
    return sum / static_cast<double>(n);
}

std::optional<double> unresolved(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    std::size_t uncertain = 0, within = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double sigma = truth.sigma[i];
        if (!mask.scored[i] || !(sigma > 0)) continue;
        ++uncertain;
        if (std::abs(static_cast<double>(v[i]) - truth.visibility[i]) < 3 * sigma) ++within;
    }
    if (uncertain == 0) return {};
    return static_cast<double>(within) / static_cast<double>(mask.count);
}

void requireReceivers(const Mask& mask) {
    if (mask.count == 0) throw BadInput("scoring a frame in which no pixel shows a receiver; turn the camera or the light");
}

} // namespace

Accuracy softAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    requireComparable(v, truth, mask);
    Accuracy result;
    result.primaryMismatch = mask.primaryMismatch;
    if (mask.count == 0) return result;

    const double n = static_cast<double>(mask.count);
    const Errors sum = errors(v, truth, mask.scored);
    result.rmse = std::sqrt(sum.squares / n);
    result.mae = sum.absolutes / n;
    if (*result.rmse > 0) result.psnr = -20 * std::log10(*result.rmse); // peak 1
    result.bad30 = shareAbove(v, truth.visibility, mask, 30.0 / 255.0);
    result.bad8 = shareAbove(v, truth.visibility, mask, 8.0 / 255.0);
    result.ssim = ssim(v, truth, mask);
    result.penumbraRmse = penumbraRmse(v, truth, mask);
    result.penumbraWidthError = penumbraWidthError(v, truth, mask);
    result.umbraLeak = umbraLeak(v, truth, mask);
    result.unresolved = unresolved(v, truth, mask);
    return result;
}

double shareAbove(const Image<float>& a, const Image<float>& b, const Mask& mask, double threshold) {
    if (!a.sameSize(mask.scored) || !b.sameSize(mask.scored))
        throw InternalError("comparing images of different sizes; render both at one size");
    requireReceivers(mask);
    std::size_t above = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (mask.scored[i] && std::abs(static_cast<double>(a[i]) - b[i]) > threshold) ++above;
    return static_cast<double>(above) / static_cast<double>(mask.count);
}

double rmse(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    requireComparable(v, truth, mask);
    requireReceivers(mask);
    return std::sqrt(errors(v, truth, mask.scored).squares / static_cast<double>(mask.count));
}

} // namespace shadowbench::metrics
