// Scoring soft-shadow techniques on halfPlaneScene(), where under the edge of a large plate the penumbra of a rectangle
// whose sides are parallel to the edge is a linear ramp; and on strips over the same slab, whose shadows are differences of
// ramps.
#pragma once

#include "tests/support/stages.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace shadowbench {

/// Metres along x on that slab: lit up to the first, umbra from the last, and between them the hard shadow's edge of the
/// light's centre.
inline constexpr double litUntil = 0.025, hardEdge = 0.4, umbraFrom = 0.775;

/// A pixel that sees the top of the slab.
struct SlabPoint {
    glm::dvec3 at;
    double visibility; // the technique's
    double truth;
};

inline std::vector<SlabPoint> slabPoints(const Stage& stage, const Image<float>& v) {
    const metrics::Drawn drawn = stage.drawn();
    std::vector<SlabPoint> points;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] == 1 && p.y > -0.001) points.push_back({p, v[i], halfPlaneVisibility(p)});
    }
    EXPECT_GT(points.size(), 3000U);
    return points;
}

/// Root mean square of the error over the points for which `counts`.
template <typename Counts>
double rmsErrorWhere(const std::vector<SlabPoint>& points, Counts counts) {
    double sum = 0;
    std::size_t count = 0;
    for (const SlabPoint& point : points) {
        if (!counts(point)) continue;
        sum += (point.visibility - point.truth) * (point.visibility - point.truth);
        ++count;
    }
    EXPECT_GT(count, 100U);
    return std::sqrt(sum / static_cast<double>(count));
}

inline double rmsError(const std::vector<SlabPoint>& points) {
    return rmsErrorWhere(points, [](const SlabPoint&) { return true; });
}

/// Over the true penumbra, in which a hard shadow errs by ½/√3.
inline double penumbraRmsError(const std::vector<SlabPoint>& points) {
    return rmsErrorWhere(points, [](const SlabPoint& point) { return point.truth > 0 && point.truth < 1; });
}

/// Mean visibility of the points whose x lies within `reach` of `x`.
inline double visibilityAt(const std::vector<SlabPoint>& points, double x, double reach = 0.02) {
    double sum = 0;
    std::size_t count = 0;
    for (const SlabPoint& point : points)
        if (std::abs(point.at.x - x) <= reach) {
            sum += point.visibility;
            ++count;
        }
    EXPECT_GT(count, 0U) << "no pixel at x = " << x;
    return sum / static_cast<double>(count);
}

/// The range of x over which visibility lies strictly between `low` and `high`, in metres; 0 where there is no such point.
inline double widthBetween(const std::vector<SlabPoint>& points, double low, double high) {
    double from = 1e30, to = -1e30;
    for (const SlabPoint& point : points)
        if (point.visibility > low && point.visibility < high) {
            from = std::min(from, point.at.x);
            to = std::max(to, point.at.x);
        }
    return std::max(0.0, to - from);
}

/// The half-plane's plate falling off from the same edge at 55°: its shadow is the same, its texels lie at many depths.
inline Scene fallingPlateScene(int side = 96) {
    Scene scene = halfPlaneScene(side);
    scene.objects[1] = object(box({1, 0.002, 1}), {0, 0, 0});
    glm::dmat4& place = scene.objects[1].instances[0].place;
    place = glm::translate(glm::dmat4(1), glm::dvec3(0.3, 2, 0.2));
    place = glm::rotate(place, glm::radians(-55.0), glm::dvec3(0, 0, 1));
    place = glm::scale(place, glm::dvec3(2.2, 1, 24));
    place = glm::translate(place, glm::dvec3(0.5, 0, 0));
    return scene;
}

/// The slab and light of halfPlaneScene() beside a box, whose front side, at z = −0.3, the light sees at a slant: in a map,
/// depth falls off steeply there.
inline Scene steepSideScene(int side = 96) {
    Scene scene = halfPlaneScene(side);
    scene.objects[1] = object(box({1.5, 2, 1}), {0.1, 1, -0.8});
    return scene;
}

/// A thin plate over that slab in place of the half-plane: long in z, from `low` to `high` along x.
struct Strip {
    double height, low, high; // metres
};

/// The slab and light of halfPlaneScene() under strips that reach beyond the light's view from every point |z| < 1 m.
inline Scene stripScene(const std::vector<Strip>& strips, int side = 96) {
    Scene scene = halfPlaneScene(side);
    scene.objects.pop_back();
    for (const Strip& strip : strips)
        scene.objects.push_back(
            object(box({strip.high - strip.low, 0.002, 8}), {0.5 * (strip.low + strip.high), strip.height + 0.001, 0.2}));
    return scene;
}

/// What `strips` hide of the light from a point of the slab: of all of it, and counted once for each strip that hides it.
struct HiddenShare {
    double once, each;

    /// The share that is hidden twice, where no more than two strips hide the same.
    [[nodiscard]] double overlap() const { return each - once; }
};

inline HiddenShare hiddenBy(const std::vector<Strip>& strips, const Light& light, const glm::dvec3& p) {
    std::vector<std::pair<double, double>> hidden; // in light widths
    for (const Strip& strip : strips) {
        const auto seen = [&](double x) { // the light's x behind the strip's
            const double onLight = p.x + (x - p.x) * light.centre.y / strip.height;
            return std::clamp((onLight - light.centre.x) / light.u.x + 0.5, 0.0, 1.0);
        };
        hidden.emplace_back(seen(strip.low), seen(strip.high));
    }
    std::sort(hidden.begin(), hidden.end());
    HiddenShare share{0, 0};
    double reached = 0;
    for (const auto& [low, high] : hidden) {
        share.each += high - low;
        share.once += std::max(0.0, high - std::max(low, reached));
        reached = std::max(reached, high);
    }
    return share;
}

/// The slab's points within 1 m of the middle of `strips` along z, with their truth.
inline std::vector<SlabPoint> stripPoints(const Stage& stage, const Image<float>& v, const std::vector<Strip>& strips) {
    std::vector<SlabPoint> points;
    for (SlabPoint point : slabPoints(stage, v)) {
        if (std::abs(point.at.z - 0.2) > 1) continue;
        point.truth = 1 - hiddenBy(strips, stage.shown().light, point.at).once;
        points.push_back(point);
    }
    return points;
}

/// "Overlap δ": two strips that touch as seen from the light's centre, x = 0.1. Beside it, at x > 0.1, the receiver sees
/// them overlap; on the other side, it sees light between them.
inline const std::vector<Strip> touchingStrips{{3, -0.125, 0.1}, {1.5, 0.1, 0.2125}};

/// The upper strip hides the lower one from the light's centre, but from the receivers below it, most of the light is hidden
/// by the lower one.
inline const std::vector<Strip> hiddenStrip{{3, -0.005, 0.205}, {1.5, -0.035, 0.235}};

} // namespace shadowbench
