#include "techniques/environment/haar.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace shadowbench::techniques {
namespace {

/// Means (times 2) and differences of the 2 × 2 blocks of the first size × size texels of a face: the former go to its first
/// quarter, the latter to the other three.
void transformOnce(std::span<double> face, int side, int size, std::vector<double>& before) {
    before.assign(face.begin(), face.end());
    const auto at = [side](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
    };
    const int half = size / 2;
    for (int y = 0; y < half; ++y)
        for (int x = 0; x < half; ++x) {
            const double a = before[at(2 * x, 2 * y)], b = before[at(2 * x + 1, 2 * y)];
            const double c = before[at(2 * x, 2 * y + 1)], d = before[at(2 * x + 1, 2 * y + 1)];
            face[at(x, y)] = 0.5 * (a + b + c + d);
            face[at(half + x, y)] = 0.5 * (a - b + c - d);
            face[at(x, half + y)] = 0.5 * (a + b - c - d);
            face[at(half + x, half + y)] = 0.5 * (a - b - c + d);
        }
}

} // namespace

void haarTransform(std::span<double> cubeMap, int side) {
    const std::size_t texels = cubeMap.size() / 6;
    std::vector<double> before;
    for (std::size_t face = 0; face < 6; ++face)
        for (int size = side; size > 1; size /= 2) transformOnce(cubeMap.subspan(face * texels, texels), side, size, before);
}

std::size_t haarSupport(std::size_t index, int side) {
    const auto across = static_cast<std::size_t>(side);
    const std::size_t inFace = index % (across * across);
    const std::size_t scale = std::bit_floor(std::max(inFace % across, inFace / across)); // functions of its kind in a row
    const std::size_t width = across / std::max<std::size_t>(scale, 1);
    return width * width;
}

std::vector<std::size_t> largestCoefficients(std::span<const double> coefficients, int side, std::size_t count) {
    // A function of unit norm over `support` texels is 1/√support in size.
    std::vector<double> weights(coefficients.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = std::abs(coefficients[i]) * std::sqrt(static_cast<double>(haarSupport(i, side)));
    std::vector<std::size_t> order(coefficients.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return weights[i]; });
    order.resize(std::min(count, order.size()));
    return order;
}

} // namespace shadowbench::techniques
