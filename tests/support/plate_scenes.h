// Relatives of halfPlaneScene(): one plate of another height, a quarter of a plane, a strip, two plates; all with closed
// forms at some points of the slab.
#pragma once

#include "scene/meshes/primitives.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

/// A horizontal plate of 2 mm whose lower side is at `height`, over x ≥ edge and all z.
inline Object plate(double height, double edge) { return object(box({20, 0.002, 40}), {edge + 10, height + 0.001, 0}); }

/// Where the edge of a plate at `height` must be for the light's centre to cast its hard shadow on x = at.
inline double edgeFor(double height, double at) { return at + (0.1 - at) * height / 6; }

/// The half-plane scene with its plate at another height, its hard shadow's edge at the same place.
inline Scene halfPlaneAt(double height, int side = 96) {
    Scene scene = halfPlaneScene(side);
    scene.objects[1] = plate(height, edgeFor(height, hardEdge));
    return scene;
}

/// The scene with a small plate high above the camera's view, whose shadow falls beside the slab: the nearest depth of the
/// map is then not that of the plate that is looked at.
inline Scene withHigherPlate(Scene scene) {
    scene.objects.push_back(object(box({0.3, 0.002, 0.3}), {-5, 4.5, -5}));
    return scene;
}

/// The plate over x ≥ 0.3 and z ≥ 0.2 only: its corner's hard shadow is at (hardEdge, 0.2), where ¾ of the light are
/// visible.
inline Scene quarterPlaneScene() {
    Scene scene = halfPlaneScene();
    scene.objects[1] = object(box({20, 0.002, 20}), {10.3, 2.001, 10.2});
    return scene;
}

/// A strip along z instead of the plate, 0.1 m wide: from below its shadow's middle it hides a fifth of the light.
inline Scene stripScene() {
    Scene scene = halfPlaneScene();
    scene.objects[1] = object(box({0.1, 0.002, 12}), {edgeFor(2, 0.25), 2.001, 0});
    return scene;
}
inline constexpr double stripShadowMiddle = 0.25;

/// Mean visibility of the points within `reach` of (x, z) along both axes.
inline double visibilityAround(const std::vector<SlabPoint>& points, double x, double z, double reach = 0.05) {
    double sum = 0, count = 0;
    for (const SlabPoint& point : points) {
        if (std::abs(point.at.x - x) > reach || std::abs(point.at.z - z) > reach) continue;
        sum += point.visibility;
        ++count;
    }
    EXPECT_GT(count, 0) << "no pixel at " << x << ", " << z;
    return sum / count;
}

/// Metres along x on the slab per texel of a map from the light's centre that holds all of halfPlaneScene().
inline double halfPlaneTexel(int map) {
    const double farthest = (20.3 - 0.1) / (6 - 2.002), nearest = (6 + 0.1) / 6; // slopes of the plate's and the slab's ends
    return 6 * (farthest + nearest) / map;
}

/// Both meshes as one, the second shifted.
inline Mesh joined(Mesh mesh, const Mesh& second, const glm::vec3& shift) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (const glm::vec3& p : second.positions) mesh.positions.push_back(p + shift);
    for (const glm::uvec3& t : second.triangles) mesh.triangles.push_back(t + first);
    return mesh;
}

inline void expectNoAnswerForALine(const std::string& variant) {
    Scene scene = halfPlaneScene();
    scene.light = {LightKind::Line, {0.1, 6, 0.2}, {0, -1, 0}, {1.5, 0, 0}, {}};
    const auto reason = techniques::parseVariant(variant).entry->notApplicable(scene);
    EXPECT_EQ(reason.value_or(""), "needs a light with a width and a height; the light of test is a line");
    EXPECT_FALSE(techniques::parseVariant(variant).entry->notApplicable(halfPlaneScene()).has_value());
}

} // namespace shadowbench
