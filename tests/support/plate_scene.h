// A square plate of 1 m at a third of an area light's height, right below its middle: shadow and outer penumbra on the slab
// are squares about the light's foot.
#pragma once

#include "tests/support/stages.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {

/// The slab under the plate at a height of 2 m and a square light of `side` metres at 6 m. The eye looks under the plate.
inline Scene plateScene(double side, int pixels = 128) {
    Scene scene = groundScene(pixels);
    scene.light = {LightKind::Rectangle, {0.1, 6, 0.2}, {0, -1, 0}, {side, 0, 0}, {0, 0, side}};
    scene.camera = {{4.6, 1.7, 1.3}, {0.1, 0, 0.2}, {0, 1, 0}, 34, 0.5, 40};
    scene.objects.push_back(object(box({1, 0.002, 1}), {0.1, 2.001, 0.2}));
    return scene;
}

/// Half the side of the hard shadow, and how far the true penumbra reaches out of it and into it.
inline constexpr double plateShadow = 0.75;
inline double platePenumbra(double side) { return side / 4; }

/// A pixel that sees the slab's top: how far its point lies from the hard shadow along x and z (0: within its width), the
/// visibility there, and the ground that the pixel covers, in units of their own.
struct PlatePoint {
    double x, z;
    double visibility;
    double area;
    glm::dvec2 fromFoot; // |x| and |z| from the light's foot
};

inline std::vector<PlatePoint> platePoints(const Scene& scene, const Stage& stage, const Image<float>& v) {
    const metrics::Drawn drawn = stage.drawn();
    std::vector<PlatePoint> points;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p(drawn.position[i]);
        if (drawn.id[i] != 1 || p.y < -0.001) continue;
        const double x = std::abs(p.x - 0.1), z = std::abs(p.z - 0.2);
        const double away = glm::dot(p - scene.camera.eye, scene.camera.basis().forward);
        points.push_back({std::max(0.0, x - plateShadow), std::max(0.0, z - plateShadow), v[i], away * away * away, {x, z}});
    }
    EXPECT_GT(points.size(), 3000U);
    return points;
}

/// The area of the points for which `counts`.
template <typename Counts>
double areaWhere(const std::vector<PlatePoint>& points, Counts counts) {
    double sum = 0;
    for (const PlatePoint& point : points)
        if (counts(point)) sum += point.area;
    return sum;
}

/// Share of the umbra's area (what an 8-bit image shows as black) that is lost as the light grows from 0.5 to 2 m a side.
inline double lossOfUmbra(const std::string& variant) {
    const auto umbra = [&](double side) {
        const Scene scene = plateScene(side);
        Stage stage(scene);
        stage.show(0);
        return areaWhere(platePoints(scene, stage, rendered(stage, variant)),
                         [](const PlatePoint& point) { return point.visibility < 0.5 / 255; });
    };
    return 1 - umbra(2) / umbra(0.5);
}

/// The same of the truth.
inline double trueLossOfUmbra() {
    const Scene scene = plateScene(1);
    Stage stage(scene);
    stage.show(0);
    const auto points = platePoints(scene, stage, rendered(stage, "none"));
    const auto umbra = [&](double side) {
        const double half = plateShadow - platePenumbra(side);
        return areaWhere(points, [&](const PlatePoint& p) { return std::max(p.fromFoot.x, p.fromFoot.y) < half; });
    };
    return 1 - umbra(2) / umbra(0.5);
}

/// Two plates at one height whose penumbrae overlap, or one of them.
inline Scene neighbours(bool left, bool right) {
    Scene scene = plateScene(1, 96);
    scene.objects.pop_back();
    if (left) scene.objects.push_back(object(box({0.8, 0.002, 0.9}), {-0.35, 2.001, 0.2}, 13));
    if (right) scene.objects.push_back(object(box({0.6, 0.002, 0.7}), {0.55, 2.001, 0.3}, -21));
    return scene;
}

inline Image<float> neighboursImage(bool left, bool right, const std::string& variant) {
    const Scene scene = neighbours(left, right);
    Stage stage(scene);
    stage.show(0);
    return rendered(stage, variant);
}

/// The visibility of both is the lesser one of either, wherever the slab is seen.
inline void expectTheDarkerWhereTwoOverlap(const std::string& variant) {
    const Image<float> left = neighboursImage(true, false, variant), right = neighboursImage(false, true, variant);
    const Image<float> both = neighboursImage(true, true, variant);
    const Scene scene = neighbours(true, true);
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    std::size_t overlapped = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        if (drawn.id[i] != 1) continue;
        EXPECT_EQ(both[i], std::min(left[i], right[i])) << i;
        overlapped += left[i] > 0 && left[i] < 1 && right[i] > 0 && right[i] < 1 ? 1 : 0;
    }
    EXPECT_GT(overlapped, 20U);
}

/// What hangs on a caster's outline does not darken its own top.
inline void expectTopsLitUpToTheirRims(const std::string& variant) {
    Scene scene = boxScene(192);
    scene.light = {LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, variant);
    const metrics::Drawn drawn = stage.drawn();
    std::size_t top = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (drawn.id[i] != 2 || drawn.position[i].y < 1.399F) continue;
        EXPECT_EQ(v[i], 1) << i;
        ++top;
    }
    EXPECT_GT(top, 500U);
}

} // namespace shadowbench
