#include "gate/check/mistakes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::gate {
namespace {

using Taken = std::function<std::optional<Snapshot>(const Snapshot&, const Snapshot&, glm::ivec2)>;

/// A mistake that changes the snapshot in place and does not look at another one.
Taken changed(std::function<void(Snapshot&)> change) {
    return [change](const Snapshot& shown, const Snapshot&, glm::ivec2) {
        Snapshot taken = shown;
        change(taken);
        return std::optional(std::move(taken));
    };
}

/// Moves the light's place, or the way that it shines.
Taken lightAt(std::function<glm::dvec3(const glm::dvec3&)> place) {
    return changed([place](Snapshot& taken) {
        Light& light = taken.light;
        (light.kind == LightKind::Directional ? light.direction : light.centre) =
            place(light.kind == LightKind::Directional ? light.direction : light.centre);
    });
}

/// Only of lights with a place.
Taken placedAt(std::function<glm::dvec3(const Snapshot&)> place) {
    return [place](const Snapshot& shown, const Snapshot&, glm::ivec2) -> std::optional<Snapshot> {
        if (shown.light.kind == LightKind::Directional) return {};
        Snapshot taken = shown;
        taken.light.centre = place(shown);
        return taken;
    };
}

Taken worlds(std::function<glm::dmat4(const glm::dmat4&)> world) {
    return changed([world](Snapshot& taken) {
        for (Batch& batch : taken.batches)
            for (Placement& placement : batch.placements) placement.world = world(placement.world);
    });
}

/// With another half of the field of view's angle, by its tangent. None that sees all or nothing.
Taken widened(std::function<double(double degrees, double aspect)> tangent) {
    return [tangent](const Snapshot& shown, const Snapshot&, glm::ivec2 size) -> std::optional<Snapshot> {
        const double half = tangent(shown.camera.fovy, static_cast<double>(size.x) / size.y);
        if (!(half > 0.01) || half > 50) return {};
        Snapshot taken = shown;
        taken.camera.fovy = glm::degrees(2 * std::atan(half));
        return taken;
    };
}

/// Looks through another point of each pixel than its centre: the picture is turned about the eye by so little that it only
/// shifts.
Taken through(glm::dvec2 offset) {
    return [offset](const Snapshot& shown, const Snapshot&, glm::ivec2 size) {
        Snapshot taken = shown;
        Camera& camera = taken.camera;
        const glm::dvec2 middle(0.5 * size.x, 0.5 * size.y);
        camera.target = camera.eye + glm::distance(camera.eye, camera.target) * camera.ray(middle + offset, size);
        return std::optional(std::move(taken));
    };
}

/// Without the open meshes that turn that side to the light: the engine culls them.
Taken withoutSheets(bool facing) {
    return changed([facing](Snapshot& taken) {
        const glm::dvec3 centre = taken.light.centre;
        for (Batch& batch : taken.batches) {
            if (batch.mesh->closed) continue;
            const Mesh& mesh = *batch.mesh;
            std::erase_if(batch.placements, [&](const Placement& placement) {
                const auto corner = [&](unsigned i) {
                    return glm::dvec3(placement.world * glm::dvec4(mesh.positions[mesh.triangles.front()[i]], 1));
                };
                const glm::dvec3 a = corner(0), normal = glm::cross(corner(1) - a, corner(2) - a);
                const glm::dvec3 towards = taken.light.kind == LightKind::Directional ? -taken.light.direction : centre - a;
                return (glm::dot(normal, towards) > 0) == facing;
            });
        }
        std::erase_if(taken.batches, [](const Batch& batch) { return batch.placements.empty(); });
    });
}

const glm::dmat4 mirroredZ(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 0, 1));

std::vector<Mistake> ofCamera() {
    std::vector<Mistake> all{
        {"its camera takes the vertical field of view for the horizontal one",
         widened([](double fovy, double aspect) { return std::tan(glm::radians(fovy) / 2) / aspect; })},
        {"its camera takes the horizontal field of view for the vertical one",
         widened([](double fovy, double aspect) { return std::tan(glm::radians(fovy) / 2) * aspect; })},
        {"its camera takes the field of view for half of it",
         widened([](double fovy, double) { return std::tan(glm::radians(fovy)); })},
        {"its camera sees half of the field of view",
         widened([](double fovy, double) { return std::tan(glm::radians(fovy) / 4); })},
        {"its camera takes degrees for radians", widened([](double fovy, double) { return std::abs(std::tan(fovy / 2)); })},
        {"its camera takes radians for degrees",
         widened([](double fovy, double) { return std::tan(glm::radians(glm::radians(fovy)) / 2); })},
        {"its camera stands still in frames in which the scene's moves",
         [](const Snapshot& shown, const Snapshot& scored, glm::ivec2) -> std::optional<Snapshot> {
             Snapshot taken = shown;
             taken.camera = scored.camera;
             return shown.camera == scored.camera ? std::nullopt : std::optional(std::move(taken));
         }},
    };
    for (const double x : {-0.5, 0.0, 0.5})
        for (const double y : {-0.5, 0.0, 0.5})
            if (x != 0 || y != 0)
                all.push_back({fmt::format("it sees pixels through ({:+g}, {:+g}) beside their centres, in pixels", x, y),
                               through({x, y})});
    return all;
}

std::vector<Mistake> ofLight() {
    return {
        {"its light is mirrored: z has the other sign (a left-handed world)",
         lightAt([](const glm::dvec3& at) { return glm::dvec3(at.x, at.y, -at.z); })},
        {"its light has y and z swapped (another axis is up)",
         lightAt([](const glm::dvec3& at) { return glm::dvec3(at.x, at.z, at.y); })},
        {"its light has y and −z swapped (another axis is up)",
         lightAt([](const glm::dvec3& at) { return glm::dvec3(at.x, -at.z, at.y); })},
        {"its light has x and z swapped", lightAt([](const glm::dvec3& at) { return glm::dvec3(at.z, at.y, at.x); })},
        {"its light shines the other way: the direction's sign is wrong", lightAt([](const glm::dvec3& at) { return -at; })},
        {"its light is mirrored: x has the other sign",
         lightAt([](const glm::dvec3& at) { return glm::dvec3(-at.x, at.y, at.z); })},
        {"its light's place is in another unit: a hundred times as far",
         placedAt([](const Snapshot& shown) { return 100.0 * shown.light.centre; })},
        {"its light's place is in another unit: a hundredth as far",
         placedAt([](const Snapshot& shown) { return 0.01 * shown.light.centre; })},
        {"its light's place is taken in the camera's coordinates", placedAt([](const Snapshot& shown) {
             return glm::dvec3(glm::inverse(shown.camera.view()) * glm::dvec4(shown.light.centre, 1));
         })},
        {"its light stands still in frames in which the scene's moves",
         [](const Snapshot& shown, const Snapshot& scored, glm::ivec2) -> std::optional<Snapshot> {
             Snapshot taken = shown;
             taken.light = scored.light;
             return shown.light == scored.light ? std::nullopt : std::optional(std::move(taken));
         }},
    };
}

std::vector<Mistake> ofMeshes() {
    return {
        {"its meshes stand at the origin: their nodes' matrices are ignored",
         worlds([](const glm::dmat4&) { return glm::dmat4(1); })},
        {"its meshes are not turned: of their nodes' matrices the translation alone is there",
         worlds([](const glm::dmat4& world) {
             glm::dmat4 moved(1);
             moved[3] = world[3];
             return moved;
         })},
        {"its meshes are turned the other way: their nodes' matrices are read row by row",
         worlds([](const glm::dmat4& world) {
             glm::dmat4 turned = glm::transpose(world);
             for (int column = 0; column < 3; ++column) turned[column][3] = 0;
             turned[3] = world[3];
             return turned;
         })},
        {"its meshes are mirrored: z has the other sign (a left-handed world)",
         worlds([](const glm::dmat4& world) { return mirroredZ * world; })},
        {"its moving meshes stand still",
         [](const Snapshot& shown, const Snapshot& scored, glm::ivec2) -> std::optional<Snapshot> {
             Snapshot taken = shown;
             taken.batches = scored.batches;
             return shown.frame == scored.frame ? std::nullopt : std::optional(std::move(taken));
         }},
        {"open meshes that face the light are not there", withoutSheets(true)},
        {"open meshes that face away from the light are not there", withoutSheets(false)},
    };
}

} // namespace

const std::vector<Mistake>& mistakes() {
    static const std::vector<Mistake> all = [] {
        std::vector<Mistake> joined = ofCamera();
        std::ranges::move(ofLight(), std::back_inserter(joined));
        std::ranges::move(ofMeshes(), std::back_inserter(joined));
        return joined;
    }();
    return all;
}

} // namespace shadowbench::gate
