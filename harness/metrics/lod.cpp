#include "harness/metrics/lod.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace shadowbench::metrics {
namespace {

constexpr int changed = 30; // of 255: what the EGSR paper counts as a visible difference

template <typename T>
void requireSameSize(const ColourImage& a, const Image<T>& b) {
    if (!a.sameSize(b)) throw InternalError("pictures of different sizes are compared");
}

/// Mean of `term` of the channels' differences, which are −255 … 255.
template <typename Term>
double meanOf(const ColourImage& a, const ColourImage& b, const Term& term) {
    requireSameSize(a, b);
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) sum += term(a[i][channel] - b[i][channel]);
    return static_cast<double>(sum) / (3 * static_cast<double>(a.size()));
}

bool isChanged(const glm::u8vec3& a, const glm::u8vec3& b) {
    for (int channel = 0; channel < 3; ++channel)
        if (std::abs(a[channel] - b[channel]) > changed) return true;
    return false;
}

/// Clears the region of `marked` around `start` and returns its number of pixels.
std::size_t takeRegion(Image<std::uint8_t>& marked, int startX, int startY) {
    std::vector<std::pair<int, int>> open{{startX, startY}};
    marked(startX, startY) = 0;
    std::size_t count = 0;
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        ++count;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            if (!marked.contains(x + dx, y + dy) || marked(x + dx, y + dy) == 0) continue;
            marked(x + dx, y + dy) = 0;
            open.emplace_back(x + dx, y + dy);
        }
    }
    return count;
}

int medianAround(const ColourImage& image, int x, int y, int channel) {
    std::array<int, 9> values{};
    std::size_t count = 0;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
            if (image.contains(u, v)) values[count++] = image(u, v)[channel];
    std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
    return values[count / 2];
}

} // namespace

double meanChange(const ColourImage& a, const ColourImage& b) {
    return meanOf(a, b, [](int difference) { return std::abs(difference); }) / 255;
}

double meanSquare(const ColourImage& a, const ColourImage& b) {
    return meanOf(a, b, [](int difference) { return difference * difference; }) / (255.0 * 255.0);
}

std::size_t largestChangedRegion(const ColourImage& a, const ColourImage& b) {
    requireSameSize(a, b);
    Image<std::uint8_t> marked(a.width(), a.height());
    for (std::size_t i = 0; i < a.size(); ++i) marked[i] = isChanged(a[i], b[i]) ? 1 : 0;
    std::size_t largest = 0;
    for (int y = 0; y < marked.height(); ++y)
        for (int x = 0; x < marked.width(); ++x)
            if (marked(x, y) != 0) largest = std::max(largest, takeRegion(marked, x, y));
    return largest;
}

double speckle(const ColourImage& image, const Image<unsigned>& mask) {
    requireSameSize(image, mask);
    std::int64_t sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            if (mask(x, y) == 0) continue;
            for (int channel = 0; channel < 3; ++channel)
                sum += std::abs(image(x, y)[channel] - medianAround(image, x, y, channel));
        }
    return static_cast<double>(sum) / (3 * 255.0);
}

} // namespace shadowbench::metrics
