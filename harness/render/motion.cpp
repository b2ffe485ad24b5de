#include "harness/render/motion.h"

#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <variant>

namespace shadowbench {
namespace {

constexpr double share = 0.01; // small as from one frame to the next, and no view is another one for it

/// `direction` turned towards x, or towards z where it runs nearly along x.
glm::dvec3 turned(const glm::dvec3& direction) {
    const glm::dvec3 axis = std::abs(direction.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(axis - glm::dot(axis, direction) * direction);
    return glm::normalize(direction + std::tan(share) * across);
}

struct Brighter {
    void operator()(ConstantSky& sky) const { sky.radiance *= 1 + share; }
    void operator()(HarmonicSky& sky) const {
        for (double& coefficient : sky.coefficients) coefficient *= 1 + share;
    }
    void operator()(ImageSky& sky) const {
        for (float& radiance : sky.radiance) radiance *= static_cast<float>(1 + share);
    }
};

Light displaced(Light light, double distance) {
    if (light.isEnvironment()) {
        EnvironmentLight environment = *light.environment;
        for (Sun& sun : environment.suns) sun.direction = turned(sun.direction);
        std::visit(Brighter(), environment.sky);
        return environmentLight(std::move(environment));
    }
    if (light.kind == LightKind::Directional)
        light.direction = turned(light.direction);
    else
        light.centre.x += distance;
    return light;
}

void moveCasters(Snapshot& snapshot, double distance) {
    for (Batch& batch : snapshot.batches)
        for (Placement& placement : batch.placements) {
            const glm::dvec3 shift(placement.id % 2 == 0 ? -distance : distance, 0, 0);
            placement.world = glm::translate(glm::dmat4(1), shift) * placement.world;
        }
}

/// States where the placements of `now` have come from.
Snapshot after(const Snapshot& before, Snapshot now) {
    now.previousCamera = before.camera;
    for (std::size_t b = 0; b < now.batches.size(); ++b) {
        Batch& batch = now.batches[b];
        batch.previousMesh.reset(); // a pose is kept
        batch.moving = false;
        for (std::size_t i = 0; i < batch.placements.size(); ++i) {
            batch.placements[i].previous = before.batches[b].placements[i].world;
            batch.moving = batch.moving || batch.moves(batch.placements[i]);
        }
    }
    return now;
}

} // namespace

Casters castersUnder(const techniques::Entry& entry, const Scene& scene) {
    if (!entry.notApplicable) return Casters::Move;
    Scene moving = scene;
    for (Object& object : moving.objects) object.motion.degreesPerFrame = 1;
    return entry.notApplicable(moving) ? Casters::Stand : Casters::Move;
}

Snapshot displaced(const Snapshot& standing, Casters casters) {
    const Bounds bounds = standing.bounds();
    const double distance = share * glm::distance(glm::dvec3(bounds.low), glm::dvec3(bounds.high));
    Snapshot elsewhere = standing;
    elsewhere.light = displaced(standing.light, distance);
    if (casters == Casters::Move) moveCasters(elsewhere, distance);
    return after(standing, std::move(elsewhere));
}

Snapshot returned(const Snapshot& standing, Casters casters) { return after(displaced(standing, casters), standing); }

} // namespace shadowbench
