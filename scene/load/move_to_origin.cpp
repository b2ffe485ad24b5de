#include "scene/load/scene_file.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <initializer_list>

namespace shadowbench {
namespace {

/// The eye's distance from the origin, in view distances, from which on a scene is moved. Nearer, a step of single precision
/// at the eye is less than a millionth of the view distance: a thousandth of a pixel at the target.
constexpr double mostDistance = 16;

void move(Track& track, const glm::dvec3& by) {
    for (Track::Key& key : track.keys) key.value += by;
}

} // namespace

void moveToOrigin(Scene& scene) {
    Camera& camera = scene.camera;
    const double view = glm::distance(camera.eye, camera.target);
    if (glm::length(camera.eye) <= mostDistance * view) return;
    const double step = std::exp2(std::floor(std::log2(view))); // a power of two: differences of what is near are exact
    const glm::dvec3 by = -step * glm::round(camera.eye / step);
    scene.moved = by;
    camera.eye += by;
    camera.target += by;
    for (Track* track : {&scene.eye, &scene.target}) move(*track, by);
    if (scene.light.kind != LightKind::Directional && !scene.light.isEnvironment()) {
        scene.light.centre += by;
        move(scene.lightCentre, by);
    }
    for (Object& object : scene.objects)
        for (Instance& instance : object.instances) instance.place[3] += glm::dvec4(by, 0);
    if (!scene.lod) return;
    for (Track* track : {&scene.lod->eye, &scene.lod->target}) move(*track, by);
}

} // namespace shadowbench
