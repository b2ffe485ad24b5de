#include "harness/render/walk.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>

namespace shadowbench::lod {
namespace {

using techniques::LodInstance;
using techniques::LodSelection;

Bounds boundsOf(const Object& object) {
    Bounds all;
    for (const Level& level : object.levels) all.add(level.mesh->bounds());
    return all;
}

/// Whether all corners of the box lie outside one and the same plane of the frustum.
bool isOutside(const Bounds& box, const glm::dmat4& clipFromObject) {
    std::array<int, 6> outside{};
    for (const glm::dvec3& corner : box.corners()) {
        const glm::dvec4 clip = clipFromObject * glm::dvec4(corner, 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = clip[static_cast<int>(axis)];
            outside[2 * axis] += at < -clip.w ? 1 : 0;
            outside[2 * axis + 1] += at > clip.w ? 1 : 0;
        }
    }
    return std::ranges::any_of(outside, [](int corners) { return corners == 8; });
}

const LodWalk& walkOf(const Scene& scene) {
    if (!scene.lod) throw BadInput(fmt::format("scene {} has no walk for levels of detail: add a [lod] section", scene.id));
    return *scene.lod;
}

Camera cameraAt(const Scene& scene, double frame) {
    const LodWalk& walk = walkOf(scene);
    Camera camera = scene.camera;
    camera.eye = walk.eye.at(frame, camera.eye);
    camera.target = walk.target.at(frame, camera.target);
    return camera;
}

/// Frame `shown` of the walk with the levels of frame `selected`.
WalkFrame frameOf(const Scene& scene, int shown, int selected, double aspect) {
    const int before = std::max(0, shown - 1);
    WalkFrame frame{cameraAt(scene, shown), cameraAt(scene, before), {}};
    const glm::dmat4 clipFromWorld = frame.camera.projection(aspect) * frame.camera.view();
    const glm::dvec3 selectingEye = cameraAt(scene, selected).eye;
    std::uint32_t id = 0;
    for (std::size_t chain = 0; chain < scene.objects.size(); ++chain) {
        const Object& object = scene.objects[chain];
        const Bounds bounds = boundsOf(object);
        for (const Instance& instance : object.instances) {
            ++id;
            const glm::dmat4 world = placeAt(object, instance, shown);
            if (isOutside(bounds, clipFromWorld * world)) continue;
            const double distance = glm::distance(selectingEye, glm::dvec3(placeAt(object, instance, selected)[3]));
            frame.instances.push_back(
                {id, chain, world, placeAt(object, instance, before), select(object.levels, scene.lod->band, distance)});
        }
    }
    return frame;
}

} // namespace

std::vector<techniques::LodChain> chains(const Scene& scene) {
    std::vector<techniques::LodChain> result;
    for (const Object& object : scene.objects) {
        techniques::LodChain& chain = result.emplace_back();
        for (const Level& level : object.levels) chain.push_back({level.mesh, level.colour.value_or(object.colour)});
    }
    return result;
}

LodSelection select(const std::vector<Level>& levels, double band, double distance) {
    for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
        const double middle = levels[level].until;
        const double progress = (distance / middle - (1 - 0.5 * band)) / band;
        if (progress >= 1) continue;
        return {static_cast<int>(level), std::max(0.0, progress)};
    }
    return {static_cast<int>(levels.size()) - 1, 0};
}

std::size_t WalkFrame::inTransition() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(instances, [](const LodInstance& i) { return i.selection.inTransition(); }));
}

WalkFrame walkFrame(const Scene& scene, int index, double aspect) { return frameOf(scene, index, index, aspect); }

WalkFrame standingFrame(const Scene& scene, int index, double aspect) { return frameOf(scene, 0, index, aspect); }

Scene withTrianglesReversed(const Scene& scene) {
    Scene result = scene;
    std::map<const Mesh*, std::shared_ptr<const Mesh>> reversed; // a mesh may be shared
    for (Object& object : result.objects) {
        for (Level& level : object.levels) {
            std::shared_ptr<const Mesh>& mesh = reversed[level.mesh.get()];
            if (!mesh) {
                Mesh copy = *level.mesh;
                std::ranges::reverse(copy.triangles);
                mesh = std::make_shared<const Mesh>(std::move(copy));
            }
            level.mesh = mesh;
        }
    }
    return result;
}

} // namespace shadowbench::lod
