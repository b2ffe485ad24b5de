// Hard labels on the slab of stages.h against any closed form of its shadow.
#pragma once

#include "tests/support/stages.h"

#include <cstddef>
#include <functional>
#include <utility>

namespace shadowbench {

/// Pixels that see the slab's top, by the closed form's label, and those of them that are labelled otherwise.
struct GroundLabels {
    std::size_t lit = 0, dark = 0, falseShadow = 0, leak = 0;

    [[nodiscard]] double mismatch() const {
        return static_cast<double>(falseShadow + leak) / static_cast<double>(lit + dark);
    }
};

/// `shadowed` answers for a point of y = 0. Pixels whose label changes when they move by `margin` pixels are left out: the
/// closed form's own edge.
inline GroundLabels compareOnGround(const Scene& scene, Stage& stage, const Image<float>& v,
                                    const std::function<bool(const glm::dvec3&)>& shadowed, double margin = 0.05) {
    const metrics::Drawn drawn = stage.drawn();
    const auto labelAt = [&](double x, double y) {
        const glm::dvec3 ray = scene.camera.ray({x, y}, scene.size);
        return shadowed(scene.camera.eye - scene.camera.eye.y / ray.y * ray);
    };
    GroundLabels labels;
    for (int y = 0; y < scene.size.y; ++y)
        for (int x = 0; x < scene.size.x; ++x) {
            if (drawn.id(x, y) != 1 || drawn.position(x, y).y < -0.001F) continue;
            const bool dark = labelAt(x + 0.5, y + 0.5);
            bool edge = false;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                edge = edge || labelAt(x + 0.5 + margin * dx, y + 0.5 + margin * dy) != dark;
            if (edge) continue;
            ++(dark ? labels.dark : labels.lit);
            if (dark && v(x, y) >= 0.5F) ++labels.leak;
            if (!dark && v(x, y) < 0.5F) ++labels.falseShadow;
        }
    return labels;
}

/// The label of the shadow of `boxScene`'s box.
inline auto behindBox(const Scene& scene) {
    return [light = scene.light.centre](const glm::dvec3& p) { return meetsBox(p, light); };
}

} // namespace shadowbench
