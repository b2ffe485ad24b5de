#include "groundtruth/cgal/scanline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace shadowbench::groundtruth {
namespace {

struct Span {
    double first = 0, last = 1;
};

/// Cuts the span to where a function that is linear along it is not negative.
bool keepPositive(Span& span, double atFrom, double atTo) {
    if (atFrom < 0 && atTo < 0) return false;
    if (atFrom >= 0 && atTo >= 0) return true;
    const double zero = atFrom / (atFrom - atTo);
    if (atFrom < 0)
        span.first = std::max(span.first, zero);
    else
        span.last = std::min(span.last, zero);
    return span.first <= span.last;
}

/// Ends that are not cut keep their bits, so that edges stay joined.
glm::dvec3 along(const ShadowEdge& edge, double share) {
    if (share == 0) return edge.from.position;
    if (share == 1) return edge.to.position;
    return (1 - share) * edge.from.position + share * edge.to.position;
}

/// Uncertainty of position / w in pixels.
double pixelUncertainty(const ShadowEdge& edge, const glm::dvec3& p) {
    const glm::dvec3 error = glm::max(edge.from.error, edge.to.error);
    const double x = (error.x + std::abs(p.x / p.z) * error.z) / p.z, y = (error.y + std::abs(p.y / p.z) * error.z) / p.z;
    return 2 * (x + y);
}

std::optional<PixelEdge> clipped(const ShadowEdge& edge, glm::ivec2 size, double pixelError) {
    const double low = -(scanMargin + 1);
    const glm::dvec2 high(size.x + scanMargin + 1, size.y + scanMargin + 1);
    const glm::dvec3 &a = edge.from.position, &b = edge.to.position;
    Span span;
    const bool kept =
        keepPositive(span, edge.from.lightSide, edge.to.lightSide) && keepPositive(span, a.z, b.z) &&
        keepPositive(span, a.x - low * a.z, b.x - low * b.z) && keepPositive(span, high.x * a.z - a.x, high.x * b.z - b.x) &&
        keepPositive(span, a.y - low * a.z, b.y - low * b.z) && keepPositive(span, high.y * a.z - a.y, high.y * b.z - b.y);
    if (!kept) return std::nullopt;
    const glm::dvec3 from = along(edge, span.first), to = along(edge, span.last);
    if (from.z <= 0 || to.z <= 0) return std::nullopt;
    const double rounding = 64 * 0x1p-53 * (high.x + high.y);
    const double error = std::max(pixelUncertainty(edge, from), pixelUncertainty(edge, to)) + pixelError + rounding;
    const double everything = high.x + high.y; // also stands for an unbounded error
    return PixelEdge{glm::dvec2(from) / from.z, glm::dvec2(to) / to.z, edge.covers, error < everything ? error : everything};
}

class Scanline {
public:
    explicit Scanline(glm::ivec2 size)
        : size_(size + 2 * scanMargin), winding_{Image<int>(size_.x, size_.y), Image<std::uint8_t>(size_.x, size_.y)} {}

    void add(const PixelEdge& edge) {
        const double top = std::min(edge.from.y, edge.to.y) - edge.error,
                     bottom = std::max(edge.from.y, edge.to.y) + edge.error;
        const int first = std::max(0, static_cast<int>(std::ceil(top - 0.5)) + scanMargin);
        const int last = std::min(size_.y - 1, static_cast<int>(std::floor(bottom - 0.5)) + scanMargin);
        for (int row = first; row <= last; ++row) {
            cross(edge, row);
            markUncertain(edge, row);
        }
    }

    Winding take() { return std::move(winding_); }

private:
    static double centre(int index) { return index - scanMargin + 0.5; }

    /// First pixel whose centre is not left of x.
    [[nodiscard]] int firstFrom(double x) const {
        return std::clamp(static_cast<int>(std::ceil(x - 0.5)) + scanMargin, 0, size_.x);
    }

    static double xAt(const PixelEdge& edge, double y) {
        const double share = std::clamp((y - edge.from.y) / (edge.to.y - edge.from.y), 0.0, 1.0);
        return edge.from.x + share * (edge.to.x - edge.from.x);
    }

    void cross(const PixelEdge& edge, int row) {
        const double y = centre(row);
        const bool fromAbove = edge.from.y <= y, toAbove = edge.to.y <= y;
        if (fromAbove == toAbove) return;
        const int x = firstFrom(xAt(edge, y));
        if (x < size_.x) winding_.change(x, row) += fromAbove ? edge.covers : -edge.covers;
    }

    /// Marks the centres of the row that lie within `error` of the edge.
    void markUncertain(const PixelEdge& edge, int row) {
        const double y = centre(row);
        double a = edge.from.x, b = edge.to.x;
        if (std::abs(edge.from.y - edge.to.y) > 2 * edge.error) {
            a = xAt(edge, y - edge.error);
            b = xAt(edge, y + edge.error);
        }
        const int last = firstFrom(std::max(a, b) + 2 * edge.error);
        for (int x = firstFrom(std::min(a, b) - 2 * edge.error); x < last; ++x) winding_.uncertain(x, row) = 1;
    }

    glm::ivec2 size_;
    Winding winding_;
};

} // namespace

std::vector<PixelEdge> toPixels(const std::vector<ShadowEdge>& edges, glm::ivec2 size, double pixelError) {
    std::vector<PixelEdge> result;
    for (const ShadowEdge& edge : edges)
        if (const std::optional<PixelEdge> inside = clipped(edge, size, pixelError)) result.push_back(*inside);
    return result;
}

Winding scan(const std::vector<PixelEdge>& edges, glm::ivec2 size) {
    Scanline scanline(size);
    for (const PixelEdge& edge : edges) scanline.add(edge);
    return scanline.take();
}

} // namespace shadowbench::groundtruth
