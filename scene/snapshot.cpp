// A scene at one frame.
#include "scene/scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench {
namespace {

/// Tracks and motion run on the moving frames only, and before the still frames: everything is at rest on these.
double motionFrame(const Scene& scene, int frame) {
    return frame < 0 ? frame : std::max(0, frame - (scene.timeline.still - 1));
}

Camera cameraAt(const Scene& scene, double frame) {
    Camera camera = scene.camera;
    camera.eye = scene.eye.at(frame, camera.eye);
    camera.target = scene.target.at(frame, camera.target);
    return camera;
}

Light lightAt(const Scene& scene, double frame) {
    Light light = scene.light;
    light.centre = scene.lightCentre.at(frame, light.centre);
    light.direction = glm::normalize(scene.lightDirection.at(frame, light.direction));
    return light;
}

/// `frames` are whole, and negative ones come before the cycle.
std::size_t poseAt(const Object& object, const Instance& instance, double frames) {
    const auto count = static_cast<long>(object.poses.size());
    const long pose = (instance.pose + std::lround(frames)) % count;
    return static_cast<std::size_t>(pose < 0 ? pose + count : pose);
}

std::size_t levelAt(const Object& object, double distance) {
    for (std::size_t level = 0; level + 1 < object.levels.size(); ++level)
        if (distance <= object.levels[level].until) return level;
    return object.levels.size() - 1;
}

std::vector<Batch> byLevel(const Object& object) {
    std::vector<Batch> batches;
    for (std::size_t i = 0; i < object.levels.size(); ++i)
        batches.push_back({object.levels[i].mesh, object.shown(i), false, {}});
    return batches;
}

std::vector<Batch> byPose(const Object& object) {
    std::vector<Batch> batches;
    for (const auto& mesh : object.poses) batches.push_back({mesh, object.shown(0), false, {}});
    return batches;
}

} // namespace

glm::dvec3 Track::at(double frame, const glm::dvec3& rest) const {
    if (keys.empty()) return rest;
    if (frame <= keys.front().frame) return keys.front().value;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (frame > keys[i].frame) continue;
        const double share = (frame - keys[i - 1].frame) / (keys[i].frame - keys[i - 1].frame);
        return keys[i - 1].value + share * (keys[i].value - keys[i - 1].value);
    }
    return keys.back().value;
}

Bounds Snapshot::bounds() const {
    Bounds all;
    for (const Batch& batch : batches) {
        const Bounds box = batch.mesh->bounds();
        for (const Placement& placement : batch.placements) all.add(transformed(box, placement.world));
    }
    return all;
}

std::size_t Snapshot::triangles() const {
    std::size_t count = 0;
    for (const Batch& batch : batches) count += batch.mesh->triangles.size() * batch.placements.size();
    return count;
}

glm::dmat4 placeAt(const Object& object, const Instance& instance, double frames) {
    const glm::dvec3 shift = object.motion.shift.at(frames, glm::dvec3(0));
    const double turn = instance.phase + object.motion.degreesPerFrame * frames;
    glm::dmat4 world = glm::translate(glm::dmat4(1), shift) * instance.place;
    return turn == 0 ? world : glm::rotate(world, glm::radians(turn), object.motion.axis);
}

std::vector<int> scoredFrames(const Scene& scene) {
    std::vector<int> frames;
    for (int frame = scene.timeline.still - 1; frame < scene.timeline.frames(); ++frame) frames.push_back(frame);
    return frames;
}

Snapshot snapshot(const Scene& scene, int frame) {
    const double now = motionFrame(scene, frame);
    const double before = motionFrame(scene, std::max(frame - 1, -scene.timeline.approach));
    Snapshot result{frame, cameraAt(scene, now), cameraAt(scene, before), lightAt(scene, now), {}};

    std::uint32_t id = 0;
    for (const Object& object : scene.objects) {
        std::vector<Batch> batches = object.poses.empty() ? byLevel(object) : byPose(object);
        for (const Instance& instance : object.instances) {
            const Placement placement{placeAt(object, instance, now), placeAt(object, instance, before), ++id};
            const double distance = glm::distance(result.camera.eye, glm::dvec3(placement.world[3]));
            const std::size_t shown = object.poses.empty() ? levelAt(object, distance) : poseAt(object, instance, now);
            Batch& batch = batches[shown];
            if (!object.poses.empty()) {
                const std::size_t was = poseAt(object, instance, before); // in a batch, all were in the same one
                if (was != shown) batch.previousMesh = object.poses[was];
            }
            batch.moving = batch.moving || batch.moves(placement);
            batch.placements.push_back(placement);
        }
        for (Batch& batch : batches)
            if (!batch.placements.empty()) result.batches.push_back(std::move(batch));
    }
    return result;
}

} // namespace shadowbench
