#include "techniques/lod/lod-frame-sequential/visibility_texture.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr int side = visibilityTextureSide;

/// Texels in the order of their key get values that rise evenly from 1 to 255.
template <typename Key>
Image<std::uint8_t> ranked(const Key& key) {
    Image<std::uint8_t> texture(side, side);
    std::vector<std::size_t> order(texture.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        texture[order[rank]] = static_cast<std::uint8_t>(1 + rank * 255 / order.size());
    return texture;
}

double distanceFromCentre(std::size_t texel) {
    const std::size_t column = texel % side, row = texel / side;
    const double x = static_cast<double>(column) + 0.5 - 0.5 * side;
    const double y = static_cast<double>(row) + 0.5 - 0.5 * side;
    return x * x + y * y;
}

Image<std::uint8_t> checker() {
    constexpr int cell = side / 8;
    constexpr std::uint8_t early = 64, late = 191; // a quarter and three quarters: as near to τ as two steps come
    Image<std::uint8_t> texture(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) texture(x, y) = (x / cell + y / cell) % 2 == 0 ? early : late;
    return texture;
}

} // namespace

Image<std::uint8_t> visibilityTexture(std::string_view pattern) {
    if (pattern == "noise") return ranked([](std::size_t texel) { return hashed(texel); });
    if (pattern == "checker") return checker();
    if (pattern == "centre-out") return ranked(distanceFromCentre);
    throw InternalError("there is no visibility texture \"" + std::string(pattern) + "\"");
}

} // namespace shadowbench::techniques
