#include "harness/metrics/pixels.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>

namespace shadowbench::metrics {

void requireComparable(const ScoredFrame& frame) {
    const auto& [v, truth, mask] = frame;
    const Image<std::uint8_t>& scored = mask.scored;
    if (!v.sameSize(scored) || !truth.visibility.sameSize(scored) || !truth.id.sameSize(scored) ||
        !truth.sigma.sameSize(scored) || !truth.edgeDistance.sameSize(scored))
        throw InternalError(fmt::format(
            "scoring an image of {} × {} pixels against a mask of {} × {} and a truth of {} × {}; "
            "render all of them at one size",
            v.width(), v.height(), scored.width(), scored.height(), truth.visibility.width(), truth.visibility.height()));
    for (std::size_t i = 0; i < v.size(); ++i)
        if (scored[i] && !std::isfinite(v[i]))
            throw InternalError(
                fmt::format("scoring a visibility of {} at pixel ({}, {}); the technique must write numbers in [0, 1]", v[i],
                            i % static_cast<std::size_t>(v.width()), i / static_cast<std::size_t>(v.width())));
}

std::vector<Crossing> crossings(const Image<float>& image, const groundtruth::Reference& truth, const Mask& mask) {
    std::vector<Crossing> found;
    const auto consider = [&](glm::ivec2 a, glm::ivec2 b) {
        if (!image.contains(b.x, b.y) || !mask.scored(a.x, a.y) || !mask.scored(b.x, b.y)) return;
        if (truth.id(a.x, a.y) != truth.id(b.x, b.y)) return;
        if (isLit(image(a.x, a.y)) != isLit(image(b.x, b.y))) found.push_back({a, b});
    };
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            consider({x, y}, {x + 1, y});
            consider({x, y}, {x, y + 1});
        }
    }
    return found;
}

glm::dvec2 between(const Crossing& pair, double share) {
    return glm::dvec2(pair.a) + 0.5 + share * glm::dvec2(pair.b - pair.a);
}

double halfCrossing(const Image<float>& image, const Crossing& pair) {
    const double a = image(pair.a.x, pair.a.y);
    const double b = image(pair.b.x, pair.b.y);
    return (0.5 - a) / (b - a); // labels differ, so a ≠ b
}

Bilinear::Bilinear(glm::dvec2 position) {
    const glm::dvec2 corner(std::floor(position.x - 0.5), std::floor(position.y - 0.5));
    const glm::dvec2 share = position - 0.5 - corner;
    const glm::ivec2 base(corner);
    for (int i = 0; i < 4; ++i) {
        const int right = i % 2;
        const int down = i / 2;
        pixels[i] = base + glm::ivec2(right, down);
        weights[i] = (right ? share.x : 1 - share.x) * (down ? share.y : 1 - share.y);
    }
}

double Bilinear::operator()(const Image<float>& image) const {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        if (weights[i] > 0) sum += weights[i] * image(pixels[i].x, pixels[i].y);
    return sum;
}

bool Bilinear::within(const Mask& mask, const Image<std::uint32_t>& ids, std::uint32_t id) const {
    for (int i = 0; i < 4; ++i) {
        if (weights[i] <= 0) continue;
        const glm::ivec2 p = pixels[i];
        if (!ids.contains(p.x, p.y) || !mask.scored(p.x, p.y) || ids(p.x, p.y) != id) return false;
    }
    return true;
}

bool isSomewhere(glm::vec2 position) { return std::isfinite(position.x) && std::isfinite(position.y); }

std::optional<glm::ivec2> nearestPixel(const ScoredFrame& frame, glm::vec2 position, std::uint32_t id) {
    const glm::ivec2 pixel(glm::floor(position));
    if (!frame.v.contains(pixel.x, pixel.y) || !frame.mask.scored(pixel.x, pixel.y)) return {};
    if (frame.truth.id(pixel.x, pixel.y) != id) return {};
    return pixel;
}

double quantile(std::vector<double>& values, double q) {
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

} // namespace shadowbench::metrics
