#include "groundtruth/cgal/hard/scanline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace shadowbench::groundtruth::hard {
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

/// First and last line of centres across `axis` that the edge may meet.
std::pair<int, int> linesNear(const PixelEdge& edge, int axis, glm::ivec2 size) {
    const double low = std::min(edge.from[axis], edge.to[axis]) - edge.error,
                 high = std::max(edge.from[axis], edge.to[axis]) + edge.error;
    return {std::max(0, static_cast<int>(std::ceil(low - 0.5)) + scanMargin),
            std::min(size[axis] - 1 + scanMargin, static_cast<int>(std::floor(high - 0.5))) + scanMargin};
}

class Scanline {
public:
    explicit Scanline(glm::ivec2 size)
        : imageSize_(size),
          size_(size + 2 * scanMargin), winding_{Image<int>(size_.x, size_.y), Image<int>(size_.x, size_.y),
                                                 Image<std::uint8_t>(size_.x, size_.y)} {}

    void add(const PixelEdge& edge) {
        const auto [top, bottom] = linesNear(edge, 1, imageSize_);
        for (int row = top; row <= bottom; ++row) {
            if (const auto x = crossing(edge, 1, row))
                winding_.change(*x, row) += runsOn(edge, 1) ? edge.covers : -edge.covers;
            markUncertain(edge, row);
        }
        // Turned by a quarter, an edge that ran down runs left.
        const auto [left, right] = linesNear(edge, 0, imageSize_);
        for (int column = left; column <= right; ++column)
            if (const auto y = crossing(edge, 0, column))
                winding_.changeDown(column, *y) += runsOn(edge, 0) ? -edge.covers : edge.covers;
    }

    Winding take() { return std::move(winding_); }

private:
    static double centre(int index) { return index - scanMargin + 0.5; }

    /// First pixel along `axis` whose centre is not before the coordinate.
    [[nodiscard]] int firstFrom(double coordinate, int axis) const {
        return std::clamp(static_cast<int>(std::ceil(coordinate - 0.5)) + scanMargin, 0, size_[axis]);
    }

    /// The other coordinate of the edge's point at `coordinate` along `axis`.
    static double otherAt(const PixelEdge& edge, int axis, double coordinate) {
        const double share = std::clamp((coordinate - edge.from[axis]) / (edge.to[axis] - edge.from[axis]), 0.0, 1.0);
        return edge.from[1 - axis] + share * (edge.to[1 - axis] - edge.from[1 - axis]);
    }

    static bool runsOn(const PixelEdge& edge, int axis) { return edge.from[axis] < edge.to[axis]; }

    /// Where on a line of centres across `axis` the winding number changes because of the edge.
    [[nodiscard]] std::optional<int> crossing(const PixelEdge& edge, int axis, int line) const {
        const double at = centre(line);
        if ((edge.from[axis] <= at) == (edge.to[axis] <= at)) return std::nullopt;
        const int index = firstFrom(otherAt(edge, axis, at), 1 - axis);
        return index < size_[1 - axis] ? std::optional(index) : std::nullopt;
    }

    /// Marks the centres of the row that lie within `error` of the edge.
    void markUncertain(const PixelEdge& edge, int row) {
        const double y = centre(row);
        double a = edge.from.x, b = edge.to.x;
        if (std::abs(edge.from.y - edge.to.y) > 2 * edge.error) {
            a = otherAt(edge, 1, y - edge.error);
            b = otherAt(edge, 1, y + edge.error);
        }
        const int last = firstFrom(std::max(a, b) + 2 * edge.error, 0);
        for (int x = firstFrom(std::min(a, b) - 2 * edge.error, 0); x < last; ++x) winding_.uncertain(x, row) = 1;
    }

    glm::ivec2 imageSize_;
    glm::ivec2 size_; // with the margin
    Winding winding_;
};

} // namespace

std::optional<PixelEdge> toPixels(const ShadowEdge& edge, glm::ivec2 size, double pixelError, std::uint32_t source) {
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
    return PixelEdge{glm::dvec2(from) / from.z, glm::dvec2(to) / to.z, edge.covers, error < everything ? error : everything,
                     source};
}

std::pair<int, int> rowsNear(const PixelEdge& edge, glm::ivec2 size) { return linesNear(edge, 1, size); }

Winding scan(const std::vector<PixelEdge>& edges, glm::ivec2 size) {
    Scanline scanline(size);
    for (const PixelEdge& edge : edges) scanline.add(edge);
    return scanline.take();
}

} // namespace shadowbench::groundtruth::hard
