// Small scenes whose shadows have a closed form.
#pragma once

#include "harness/render/stage.h"
#include "scene/meshes/primitives.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "tests/support/test_context.h"

#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace shadowbench {

inline Object object(Mesh mesh, const glm::dvec3& at, double turn = 0) {
    Object result;
    result.levels.push_back({std::make_shared<const Mesh>(std::move(mesh))});
    const glm::dmat4 place = glm::translate(glm::dmat4(1), at);
    result.instances.push_back({glm::rotate(place, glm::radians(turn), glm::dvec3(0, 1, 0)), 0});
    return result;
}

/// A slab with its top at y = 0, seen slantwise from above.
inline Scene groundScene(int side = 128) {
    testContext();
    Scene scene;
    scene.id = "test";
    scene.size = {side, side};
    scene.camera = {{2.1, 6.2, 7.3}, {0.1, 0, 0.2}, {0, 1, 0}, 45, 0.5, 40};
    scene.light = {LightKind::Point, {1.7, 6.1, -2.3}, {0, -1, 0}, {}, {}};
    scene.objects.push_back(object(box({12, 0.2, 12}), {0, -0.1, 0}));
    return scene;
}

/// The slab under a box of 1.6 × 0.4 × 1.2 m whose middle floats 1.2 m above it.
inline Scene boxScene(int side = 128) {
    Scene scene = groundScene(side);
    scene.objects.push_back(object(box({1.6, 0.4, 1.2}), {0.13, 1.2, 0.21}));
    return scene;
}

/// Whether the segment between `a` and `b` meets that box.
inline bool meetsBox(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 low = glm::dvec3(0.13, 1.2, 0.21) - glm::dvec3(0.8, 0.2, 0.6);
    const glm::dvec3 high = low + glm::dvec3(1.6, 0.4, 1.2);
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = b[axis] - a[axis];
        const double t0 = (low[axis] - a[axis]) / d, t1 = (high[axis] - a[axis]) / d;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter < leave;
}

/// The slab under the edge of a large plate at height 2 m: its edge is the line x = 0.3, the plate on the side of larger x.
/// The light is a rectangle of 1.5 × 1.5 m, 6 m up, its sides along x and z.
inline Scene halfPlaneScene(int side = 96) {
    Scene scene = groundScene(side);
    scene.light = {LightKind::Rectangle, {0.1, 6, 0.2}, {0, -1, 0}, {1.5, 0, 0}, {0, 0, 1.5}};
    scene.camera = {{-1.3, 3.1, 4.4}, {-0.2, 0, 0.2}, {0, 1, 0}, 40, 0.5, 40}; // looks under the plate
    scene.objects.push_back(object(box({20, 0.002, 40}), {10.3, 2.001, 0}));
    return scene;
}

/// Visible fraction of that light at `p` on the slab: the share of the light's x range whose segments pass x < 0.3 at the
/// height of the plate's lower side (its thickness of 2 mm is below every tolerance).
inline double halfPlaneVisibility(const glm::dvec3& p) {
    const double limit = p.x + (0.3 - p.x) * 6 / 2; // light x whose segment grazes the edge
    return std::clamp((limit - (0.1 - 0.75)) / 1.5, 0.0, 1.0);
}

/// Renders frames 0 … frames−1 of a still scene and returns the last image.
inline Image<float> rendered(Stage& stage, const std::string& variant, int frames = 1, std::uint32_t seed = 1) {
    const techniques::Variant parsed = techniques::parseVariant(variant);
    const auto technique = parsed.entry->make(parsed.parameters);
    for (int frame = 0; frame < frames; ++frame) stage.render(*technique, frame, seed);
    return stage.visibility();
}

/// The figures of the first frame.
inline std::map<std::string, double> figuresOf(Stage& stage, const std::string& variant) {
    const techniques::Variant parsed = techniques::parseVariant(variant);
    const auto technique = parsed.entry->make(parsed.parameters);
    stage.render(*technique, 0, 1);
    return techniques::declaredFigures(*parsed.entry, technique->figures(stage.frame(0, 1)));
}

} // namespace shadowbench
