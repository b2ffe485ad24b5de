// Convex polygons in the image, clipped to one pixel's square. Double precision; free of CGAL.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
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

/// Of the image, in pixels.
struct ImageRectangle {
    glm::dvec2 low, high;
};

/// [x, x + 1] × [y, y + 1].
inline ImageRectangle pixelSquare(glm::ivec2 pixel) { return {glm::dvec2(pixel), glm::dvec2(pixel) + 1.0}; }

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

/// A polygon before its division into image positions: corners are (x w, y w, w) with w > 0.
class HomogeneousPolygon {
public:
    HomogeneousPolygon() = default;
    explicit HomogeneousPolygon(const Corners<glm::dvec3>& corners) : corners_(corners) {
        for (const glm::dvec3& p : corners) {
            low_ = glm::min(low_, glm::dvec2(p) / p.z);
            high_ = glm::max(high_, glm::dvec2(p) / p.z);
        }
    }

    /// Whether `rectangle` may hold a part of it.
    [[nodiscard]] bool mayMeet(const ImageRectangle& rectangle) const {
        return corners_.size() > 2 && low_.x < rectangle.high.x + slack && high_.x > rectangle.low.x - slack &&
               low_.y < rectangle.high.y + slack && high_.y > rectangle.low.y - slack;
    }
    [[nodiscard]] bool isWithin(const ImageRectangle& rectangle) const {
        return low_.x > rectangle.low.x && high_.x < rectangle.high.x && low_.y > rectangle.low.y &&
               high_.y < rectangle.high.y;
    }

    /// The part that the rectangle holds. No corners where nothing, or nothing of an area, is left.
    [[nodiscard]] ImagePolygon in(const ImageRectangle& rectangle) const {
        const glm::dvec2 low = rectangle.low, high = rectangle.high;
        Corners<glm::dvec3> held = corners_;
        // A side that all corners lie within cuts nothing off.
        if (low_.x < low.x + slack) held = clipped(held, [&](const glm::dvec3& p) { return p.x - low.x * p.z; });
        if (high_.x > high.x - slack) held = clipped(held, [&](const glm::dvec3& p) { return high.x * p.z - p.x; });
        if (low_.y < low.y + slack) held = clipped(held, [&](const glm::dvec3& p) { return p.y - low.y * p.z; });
        if (high_.y > high.y - slack) held = clipped(held, [&](const glm::dvec3& p) { return high.y * p.z - p.y; });
        ImagePolygon image;
        if (held.size() < 3) return image;
        for (const glm::dvec3& p : held) image.add({p.x / p.z, p.y / p.z});
        return image;
    }

private:
    static constexpr double slack = 1e-6; // px; more than positions are rounded by
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    Corners<glm::dvec3> corners_;
    glm::dvec2 low_{infinity}, high_{-infinity};
};

} // namespace shadowbench::groundtruth::hard
