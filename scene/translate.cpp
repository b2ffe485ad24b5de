#include "scene/scene.h"

#include <initializer_list>

namespace shadowbench {
namespace {

void move(Track& track, const glm::dvec3& by) {
    for (Track::Key& key : track.keys) key.value += by;
}

} // namespace

void translate(Scene& scene, const glm::dvec3& by) {
    scene.moved += by;
    scene.camera.eye += by;
    scene.camera.target += by;
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
