// Scenes with a closed form for filtered shadow maps: straight edges at right angles to the map's rows, far above a flat
// ground.
#pragma once

#include "tests/support/stages.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace shadowbench {

inline constexpr double edgeAt = 0.3; // metres along x

/// A slab under a plate `height` metres above it whose edge is the line x = edgeAt, the plate on the side of larger x. The
/// light shines straight down, so that the shadow's edge lies right below the plate's and the map's rows run along x.
inline Scene edgeScene(double height, int side = 192) {
    Scene scene = groundScene(side);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{edgeAt, 0.9, 6}, {edgeAt, 0, 0}, {0, 1, 0}, 20, 0.5, 40}; // looks along the edge, under the plate
    scene.objects.push_back(object(box({6, 0.1, 12}), {edgeAt + 3, height + 0.05, 0}));
    return scene;
}

/// The same with a second plate below that shades all of the slab: the ground is dark whatever the upper plate does.
inline Scene stackedScene(double lower, double upper, int side = 192) {
    Scene scene = edgeScene(upper, side);
    scene.objects.push_back(object(box({12, 0.1, 12}), {0, lower + 0.05, 0}));
    return scene;
}

/// The map of such a scene spans 12 m along x: the slab's own width.
inline double texelOf(const Scene& scene, int map) {
    const glm::dvec3 low = snapshot(scene, 0).bounds().low, high = snapshot(scene, 0).bounds().high;
    return std::max(high.x - low.x, high.z - low.z) / map;
}

/// One ground pixel: where it lies and how much light reaches it.
struct GroundPoint {
    glm::dvec3 at;
    double visibility;
};

/// Pixels that see the top of the slab, within 4 m of the middle.
inline std::vector<GroundPoint> groundPoints(const Stage& stage, const Image<float>& v) {
    const metrics::Drawn drawn = stage.drawn();
    std::vector<GroundPoint> points;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] != 1 || p.y < -0.001 || std::abs(p.x) > 4 || std::abs(p.z) > 4) continue;
        points.push_back({p, v[i]});
    }
    return points;
}

/// Width in metres along x of the ground that is neither fully lit nor fully shadowed.
inline double greyWidth(const std::vector<GroundPoint>& points, double margin = 1e-3) {
    double low = 1e30, high = -1e30;
    for (const GroundPoint& point : points) {
        if (point.visibility < margin || point.visibility > 1 - margin) continue;
        low = std::min(low, point.at.x);
        high = std::max(high, point.at.x);
    }
    return std::max(0.0, high - low);
}

/// Where the points that are nearly half lit lie along x.
inline double middleOf(const std::vector<GroundPoint>& points) {
    double sum = 0, count = 0;
    for (const GroundPoint& point : points)
        if (std::abs(point.visibility - 0.5) < 0.1) {
            sum += point.at.x;
            ++count;
        }
    EXPECT_GT(count, 0) << "no penumbra";
    return sum / count;
}

/// The greatest difference between the points' visibilities and a ramp of `width` metres around their own middle, lit at
/// smaller x: what a box of that width makes of an edge.
inline double fromRamp(const std::vector<GroundPoint>& points, double width) {
    const double middle = middleOf(points);
    double worst = 0;
    for (const GroundPoint& point : points)
        worst = std::max(worst, std::abs(point.visibility - std::clamp(0.5 - (point.at.x - middle) / width, 0.0, 1.0)));
    return worst;
}

/// The edge of the map's own shadow, which lies on a texel's border up to half a texel from the plate's: where the
/// unfiltered test changes.
inline double mapEdge(Stage& stage, int map) {
    double low = 1e30;
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, "sm-uniform:map=" + std::to_string(map))))
        if (point.visibility < 0.5) low = std::min(low, point.at.x);
    return low;
}

/// Share of a disk of radius 1 on the side of smaller x of a line at x = t.
inline double diskShare(double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / glm::pi<double>();
}

inline double brightest(const std::vector<GroundPoint>& points) {
    double most = 0;
    for (const GroundPoint& point : points) most = std::max(most, point.visibility);
    return most;
}

} // namespace shadowbench
