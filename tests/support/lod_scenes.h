// Scenes with instances in a known state of transition, and their pictures.
#pragma once

#include "harness/render/lod_stage.h"
#include "techniques/catalog.h"
#include "tests/support/stages.h"

#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {

using metrics::ColourImage;

/// Two levels in colours of their own at `at`, `progress` of the way from the first to the second as long as the distance
/// from the eye at rest stays the same.
inline Object inTransition(const Camera& camera, double band, double progress, const glm::dvec3& at, Mesh finer,
                           glm::vec3 finerColour, Mesh coarser, glm::vec3 coarserColour) {
    Object result = object(std::move(finer), at);
    result.levels[0].until = glm::distance(camera.eye, at) / (1 - 0.5 * band + progress * band);
    result.levels[0].colour = finerColour;
    result.levels.push_back({std::make_shared<const Mesh>(std::move(coarser))});
    result.levels[1].colour = coarserColour;
    return result;
}

/// A wall behind, at z = −4, and a light behind the camera, which looks along −z from (0, 0, 6).
inline Scene wallScene(int side = 96) {
    testContext();
    Scene scene;
    scene.id = "wall";
    scene.size = {side, side};
    scene.camera = {{0.013, 0.017, 6}, {0.013, 0.017, 0}, {0, 1, 0}, 40, 0.5, 40};
    scene.light = {LightKind::Point, {1, 2, 9}, {0, -1, 0}, {}, {}};
    scene.objects.push_back(object(box({30, 30, 1}), {0, 0, -4.5}));
    scene.objects.back().colour = {0.2F, 0.9F, 0.3F};
    scene.lod = LodWalk{8, 0.2, {}, {}};
    return scene;
}

inline constexpr glm::vec3 red{0.9F, 0.2F, 0.1F}, blue{0.1F, 0.3F, 0.9F}, yellow{0.9F, 0.8F, 0.1F}, violet{0.6F, 0.1F, 0.7F};

/// A tall box that turns into a wide one, 1 m apart in front of the same in other colours, in front of the wall.
inline Scene crossesScene(double progress) {
    Scene scene = wallScene();
    const auto cross = [&](const glm::dvec3& at, glm::vec3 finer, glm::vec3 coarser) {
        scene.objects.push_back(inTransition(scene.camera, scene.lod->band, progress, at, box({0.7, 1.9, 0.4}), finer,
                                             box({1.9, 0.7, 0.4}), coarser));
    };
    cross({0.4, 0.2, -2}, red, blue);
    cross({-0.3, -0.1, 0}, yellow, violet);
    return scene;
}

/// Pictures of the walk's first frames.
inline std::vector<ColourImage> walked(const Scene& scene, const std::string& variant, int frames) {
    lod::LodStage stage(scene, scene.size);
    const techniques::Variant parsed = techniques::parseVariant(variant);
    const auto technique = parsed.entry->makeLod(parsed.parameters);
    std::vector<ColourImage> pictures;
    for (int frame = 0; frame < frames; ++frame) {
        stage.show(frame);
        stage.render(*technique);
        pictures.push_back(stage.picture());
    }
    return pictures;
}

/// The scene with every object at one level, or at `level` where it has that many.
inline Scene atLevel(Scene scene, std::size_t level) {
    for (Object& object : scene.objects) {
        Level chosen = object.levels[std::min(level, object.levels.size() - 1)];
        chosen.until = std::numeric_limits<double>::infinity();
        object.levels = {chosen};
    }
    return scene;
}

/// What a walk past the scene at one level looks like.
inline ColourImage levelPicture(const Scene& scene, std::size_t level, int frame) {
    return walked(atLevel(scene, level), "lod-full", frame + 1).back();
}

} // namespace shadowbench
