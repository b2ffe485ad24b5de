#include "techniques/environment/haar.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace shadowbench::techniques {
namespace {

/// Where the four numbers of the 2 × 2 block (x, y) are: the first at column `stride` x and row `stride` y, the others
/// `step` beside and below it.
struct Layout {
    std::size_t stride, step;
};

/// Replaces the four numbers of each block among the first size × size of a face, from one layout to another, by their sums
/// (mean and differences, times 2), which are orthonormal and their own inverse.
void exchange(std::span<double> face, std::size_t side, std::size_t size, Layout from, Layout to) {
    thread_local std::vector<double> before;
    before.assign(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(side * size));
    for (std::size_t y = 0; y < size / 2; ++y)
        for (std::size_t x = 0; x < size / 2; ++x) {
            const double* in = &before[from.stride * (y * side + x)];
            const double a = in[0], b = in[from.step], c = in[from.step * side], d = in[from.step * (side + 1)];
            double* out = &face[to.stride * (y * side + x)];
            out[0] = 0.5 * (a + b + c + d);
            out[to.step] = 0.5 * (a - b + c - d);
            out[to.step * side] = 0.5 * (a + b - c - d);
            out[to.step * (side + 1)] = 0.5 * (a - b - c + d);
        }
}

constexpr Layout blocks{2, 1};

/// Each quarter holds one number of every block.
Layout quarters(std::size_t size) { return {1, size / 2}; }

std::span<double> faceOf(std::span<double> cubeMap, std::size_t face) {
    const std::size_t texels = cubeMap.size() / 6;
    return cubeMap.subspan(face * texels, texels);
}

} // namespace

void haarTransform(std::span<double> cubeMap, int side) {
    const auto whole = static_cast<std::size_t>(side);
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t size = whole; size > 1; size /= 2)
            exchange(faceOf(cubeMap, face), whole, size, blocks, quarters(size));
}

void inverseHaarTransform(std::span<double> cubeMap, int side) {
    const auto whole = static_cast<std::size_t>(side);
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t size = 2; size <= whole; size *= 2)
            exchange(faceOf(cubeMap, face), whole, size, quarters(size), blocks);
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
