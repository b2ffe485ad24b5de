#include "base/error.h"
#include "harness/metrics/frames.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::metrics {
namespace {

constexpr double relativeAgreement = 2e-3;
constexpr double absoluteAgreement = 1e-4; // metres
constexpr double mostDisagreeing = 0.001;  // docs/metrics.md, "Notation": above this a cell is an error, not a score
constexpr std::size_t mostOnEdges = 4;     // in whatever image: 0.1 % of a tiny one is less than a pixel

/// Whether what was drawn at one pixel is what the truth has at another.
bool hitsAgree(const groundtruth::Reference& truth, std::size_t pixel, const Drawn& drawn, std::size_t drawnPixel,
               const glm::dvec3& eye, double relative) {
    if (truth.id[pixel] != drawn.id[drawnPixel]) return false;
    if (truth.surface[pixel] == groundtruth::Surface::Background) return true;
    const double exact = glm::distance(glm::dvec3(truth.position[pixel]), eye);
    const double rasterised = glm::distance(glm::dvec3(drawn.position[drawnPixel]), eye);
    return std::abs(rasterised - exact) <= relative * exact + absoluteAgreement; // false for a NaN
}

/// Whether one of the eight pixels around shows in the truth what was drawn here.
bool liesOnEdge(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye, glm::ivec2 pixel) {
    constexpr double aPixelFurther = 0.05; // along a slanted surface
    const auto index = [&](glm::ivec2 p) { return static_cast<std::size_t>(p.y) * truth.id.width() + p.x; };
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::ivec2 next = pixel + glm::ivec2(dx, dy);
            if (next == pixel || !truth.id.contains(next.x, next.y)) continue;
            if (hitsAgree(truth, index(next), drawn, index(pixel), eye, aPixelFurther)) return true;
        }
    return false;
}

} // namespace

Mask receiverMask(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye) {
    if (!drawn.id.sameSize(truth.id) || !drawn.position.sameSize(truth.id) || !truth.surface.sameSize(truth.id) ||
        !truth.position.sameSize(truth.id))
        throw InternalError("masking receivers of a truth and a drawing of different sizes; render both at one size");

    Mask mask{Image<std::uint8_t>(truth.id.width(), truth.id.height())};
    std::size_t disagreeing = 0, onEdges = 0;
    for (int y = 0; y < truth.id.height(); ++y)
        for (int x = 0; x < truth.id.width(); ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * truth.id.width() + x;
            if (!hitsAgree(truth, i, drawn, i, eye, relativeAgreement)) {
                ++disagreeing;
                if (liesOnEdge(truth, drawn, eye, {x, y})) ++onEdges;
                continue;
            }
            if (truth.surface[i] != groundtruth::Surface::Receiver) continue;
            mask.scored[i] = 1;
            ++mask.count;
        }
    if (truth.id.empty()) return mask;
    mask.primaryMismatch = static_cast<double>(disagreeing) / static_cast<double>(truth.id.size());
    const bool few = disagreeing == onEdges && onEdges <= mostOnEdges;
    mask.aligned = mask.primaryMismatch <= mostDisagreeing || few;
    return mask;
}

} // namespace shadowbench::metrics
