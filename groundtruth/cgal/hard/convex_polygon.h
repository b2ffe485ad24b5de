// Convex polygons in the image, clipped to one pixel's square. Double precision; free of CGAL.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

namespace shadowbench::groundtruth::hard {

/// At most as many corners as a triangle has after being cut by nine planes.
template <class Corner>
class Corners {
public:
    void add(const Corner& corner) {
        assert(count_ < corners_.size());
        corners_[count_++] = corner;
    }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const Corner& operator[](std::size_t i) const { return corners_[i]; }
    [[nodiscard]] const Corner& after(std::size_t i) const { return corners_[i + 1 < count_ ? i + 1 : 0]; }
    [[nodiscard]] auto begin() const { return corners_.begin(); }
    [[nodiscard]] auto end() const { return corners_.begin() + static_cast<std::ptrdiff_t>(count_); }

private:
    std::array<Corner, 12> corners_;
    std::size_t count_ = 0;
};

/// The part of a convex polygon where `value`, a linear function of its corners, is not negative (Sutherland and Hodgman
/// 1974).
template <class Corner, class Value>
Corners<Corner> clipped(const Corners<Corner>& polygon, const Value& value) {
    Corners<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &here = polygon[i], &next = polygon.after(i);
        const double a = value(here), b = value(next);
        if (a >= 0) kept.add(here);
        if ((a >= 0) != (b >= 0)) kept.add(here + a / (a - b) * (next - here));
    }
    return kept;
}

/// A pixel's square [x, x + 1] × [y, y + 1], in pixels.
struct PixelSquare {
    glm::dvec2 low;
    [[nodiscard]] glm::dvec2 high() const { return low + 1.0; }
};

/// In image positions; corners may run either way round.
class ImagePolygon {
public:
    void add(glm::dvec2 corner) {
        corners_.add(corner);
        top_ = std::min(top_, corner.y);
        bottom_ = std::max(bottom_, corner.y);
    }
    [[nodiscard]] const Corners<glm::dvec2>& corners() const { return corners_; }

    /// In square pixels.
    [[nodiscard]] double area() const {
        double twice = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const glm::dvec2 a = corners_[i] - corners_[0], b = corners_.after(i) - corners_[0];
            twice += a.x * b.y - a.y * b.x;
        }
        return std::abs(twice) / 2;
    }

    /// Where the line at height `y` runs inside the polygon, if it does.
    struct Interval {
        double from, to;
    };
    [[nodiscard]] std::optional<Interval> onLine(double y) const {
        if (y < top_ || y > bottom_) return std::nullopt;
        std::optional<Interval> inside;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const glm::dvec2 &a = corners_[i], &b = corners_.after(i);
            if ((a.y <= y) == (b.y <= y)) continue;
            const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
            inside = inside ? Interval{std::min(inside->from, x), std::max(inside->to, x)} : Interval{x, x};
        }
        return inside;
    }

private:
    Corners<glm::dvec2> corners_;
    double top_ = std::numeric_limits<double>::infinity(), bottom_ = -top_;
};

/// The part of a polygon that the square holds. Corners are homogeneous, (x w, y w, w) with w > 0. No corners where nothing,
/// or nothing of an area, is left.
inline ImagePolygon inSquare(Corners<glm::dvec3> polygon, const PixelSquare& square) {
    const glm::dvec2 low = square.low, high = square.high();
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return p.x - low.x * p.z; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return high.x * p.z - p.x; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return p.y - low.y * p.z; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return high.y * p.z - p.y; });
    ImagePolygon image;
    if (polygon.size() < 3) return image;
    for (const glm::dvec3& p : polygon) image.add({p.x / p.z, p.y / p.z});
    return image;
}

} // namespace shadowbench::groundtruth::hard
