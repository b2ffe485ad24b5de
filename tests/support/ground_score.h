// Scenes for hard shadows on a ground, and scores against the box's exact shadow and against the irregular z-buffer.
#pragma once

#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "tests/support/stages.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace shadowbench {

/// Share of slab pixels whose label differs from the closed form, and its parts.
struct BoxScore {
    double mismatch = 0, falseShadow = 0, leak = 0;
};

/// Pixels whose label changes when the pixel moves by `margin` pixels are left out: the closed form's own edge.
inline BoxScore scoreOnGround(const Scene& scene, Stage& stage, const Image<float>& v, double margin) {
    const metrics::Drawn drawn = stage.drawn();
    const auto shadowed = [&](double x, double y) {
        const glm::dvec3 ray = scene.camera.ray({x, y}, scene.size);
        return meetsBox(scene.camera.eye - scene.camera.eye.y / ray.y * ray, scene.light.centre);
    };
    std::size_t lit = 0, dark = 0, falseShadow = 0, leak = 0;
    for (int y = 0; y < scene.size.y; ++y)
        for (int x = 0; x < scene.size.x; ++x) {
            if (drawn.id(x, y) != 1 || drawn.position(x, y).y < -0.001F) continue;
            const double cx = x + 0.5, cy = y + 0.5;
            const bool label = shadowed(cx, cy);
            bool edge = false;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                edge = edge || shadowed(cx + margin * dx, cy + margin * dy) != label;
            if (edge) continue;
            ++(label ? dark : lit);
            if (label && v(x, y) >= 0.5F) ++leak;
            if (!label && v(x, y) < 0.5F) ++falseShadow;
        }
    return {static_cast<double>(falseShadow + leak) / static_cast<double>(lit + dark),
            static_cast<double>(falseShadow) / static_cast<double>(lit),
            static_cast<double>(leak) / static_cast<double>(dark)};
}

/// How much a technique's first frame adds to a tally: draw calls or passes.
inline std::uint64_t tallied(Stage& stage, const std::string& name, std::uint64_t gl::Tally::*counter) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    const std::uint64_t before = testContext().tally().*counter;
    stage.render(*technique, 0, 1);
    return testContext().tally().*counter - before;
}

/// Boxes all around a light that is close to the slab: a single map cannot see half of them.
inline Scene ringScene() {
    Scene scene = groundScene(256);
    scene.light.centre = {0.1, 0.7, 0.2};
    for (int i = 0; i < 8; ++i) {
        const double angle = glm::radians(45.0 * i + 10);
        const glm::dvec3 at(2 * std::cos(angle), 0.43, 2 * std::sin(angle));
        scene.objects.push_back(object(box({0.4, 0.8, 0.3}), at, 17.0 * i));
    }
    return scene;
}

/// A ground of 200 m seen from a height of 1.7 m under a sun in the image plane, with boxes from 3 m away that grow with
/// distance.
inline Scene avenueScene(double near) {
    Scene scene = groundScene(256);
    scene.camera = {{0, 1.7, 0}, {0, 1.7, -10}, {0, 1, 0}, 50, near, 100};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.6, -1, 0)), {}, {}};
    scene.objects[0] = object(box({200, 0.2, 200}), {0, -0.1, -90});
    for (double depth = 4; depth < 60; depth *= 1.4) {
        const double size = 0.08 * depth;
        scene.objects.push_back(object(box({size, size, size}), {-0.2 * depth, 0.5 * size, -depth}, 10 * depth));
    }
    return scene;
}

/// The avenue, whose first box moves from frame 2 on and whose camera moves from frame 4 on.
inline Scene movingAvenue() {
    Scene scene = avenueScene(0.5);
    scene.timeline = {.still = 3, .moving = 4};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {4, {0.4, 0, 0}}};
    const glm::dvec3 eye = scene.camera.eye;
    scene.eye.keys = {{2, eye}, {4, eye + glm::dvec3(0.3, 0, -0.2)}};
    return scene;
}

/// Pixels whose visibility differs.
inline std::size_t differing(const Image<float>& a, const Image<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

/// Share of an object's pixels, seen at a height of at least `lowest`, whose label differs from that of stencil volumes,
/// which are exact on closed meshes. Surfaces that face away from the light are to be kept out by `lowest`.
inline double mismatchOn(unsigned id, const Scene& scene, const std::string& variant, float lowest = -1e9F) {
    Stage stage(scene);
    stage.show(0);
    const Image<float> exact = rendered(stage, "sm-alias-free"), v = rendered(stage, variant);
    const metrics::Drawn drawn = stage.drawn();
    std::size_t wrong = 0, all = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (drawn.id[i] != id || drawn.position[i].y < lowest) continue;
        ++all;
        wrong += exact[i] != v[i] ? 1 : 0;
    }
    return static_cast<double>(wrong) / static_cast<double>(all);
}

} // namespace shadowbench
