#include "harness/cells/changed_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench {

Scene withNeighbourImage(Scene scene) {
    scene.size = {neighbourOf(scene.size.x), neighbourOf(scene.size.y)};
    scene.timeline.moving = 0;
    return scene;
}

std::vector<Scene> otherViews(const Scene& scene, int count) {
    constexpr double step = 10; // degrees: another view of the same shadows, with the light still on the side it was
    std::vector<Scene> views;
    for (int view = 1; view < count; ++view) {
        Scene& other = views.emplace_back(scene);
        other.timeline = {other.timeline.still, 0, 0};
        other.eye = other.target = {}; // it stands
        const double degrees = (view % 2 == 1 ? step : -step) * ((view + 1) / 2);
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0));
        Camera& camera = other.camera;
        camera.eye = camera.target + glm::dvec3(turn * glm::dvec4(camera.eye - camera.target, 0));
        camera.up = glm::dvec3(turn * glm::dvec4(camera.up, 0));
    }
    return views;
}

} // namespace shadowbench
