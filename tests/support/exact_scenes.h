// Small scenes for the tests of the exact oracles.
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "scene/mesh.h"
#include "scene/snapshot.h"

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth::testing {

using namespace hard;

inline glm::dmat4 at(double x, double y, double z) { return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z)); }

/// Builds snapshots; surface ids count from 1 in the order of `add`.
class SceneBuilder {
public:
    SceneBuilder& add(const Mesh& mesh, const std::vector<glm::dmat4>& places = {glm::dmat4(1)}) {
        Batch batch{std::make_shared<Mesh>(mesh), glm::vec3(0.8F), false, {}};
        for (const glm::dmat4& place : places) batch.placements.push_back({place, place, ++lastId_});
        snapshot_.batches.push_back(std::move(batch));
        return *this;
    }
    SceneBuilder& pointLight(const glm::dvec3& position) {
        snapshot_.light = {LightKind::Point, position, {0, -1, 0}, glm::dvec3(0), glm::dvec3(0)};
        return *this;
    }
    SceneBuilder& directionalLight(const glm::dvec3& direction) {
        snapshot_.light = {LightKind::Directional, glm::dvec3(0), direction, glm::dvec3(0), glm::dvec3(0)};
        return *this;
    }
    SceneBuilder& camera(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up = {0, 1, 0}) {
        snapshot_.camera = {eye, target, up, 45, 0.1, 60};
        return *this;
    }
    /// Looks straight down: image rows run along x, columns along z.
    SceneBuilder& cameraAbove(double height) { return camera({0, height, 0}, {0, 0, 0}, {0, 0, -1}); }

    [[nodiscard]] Snapshot& get() { return snapshot_; }

private:
    Snapshot snapshot_;
    std::uint32_t lastId_ = 0;
};

/// A rectangle at height `y`, facing up.
inline Mesh plate(float x0, float x1, float y, float z0, float z1) {
    return {{{x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}}, {{0, 1, 2}, {0, 2, 3}}, false};
}

/// Unconnected random triangles within a box.
inline Mesh soup(int count, const glm::vec3& low, const glm::vec3& high, std::mt19937& random) {
    Mesh mesh;
    std::uniform_real_distribution<float> share(0, 1);
    for (int i = 0; i < 3 * count; ++i)
        mesh.positions.push_back(low + (high - low) * glm::vec3(share(random), share(random), share(random)));
    for (unsigned i = 0; i < static_cast<unsigned>(count); ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    return mesh;
}

/// Where the centre of a pixel meets the plane y = 0, in double precision.
inline glm::dvec3 groundPoint(const Camera& camera, int x, int y, glm::ivec2 size) {
    const glm::dvec3 ray = camera.ray({x + 0.5, y + 0.5}, size);
    return camera.eye - camera.eye.y / ray.y * ray;
}

inline Reference rayLabels(const ExactScene& scene, glm::ivec2 size, const PrimaryHits& primary) {
    Reference out;
    scene.labelByRays(size, primary, out);
    return out;
}

} // namespace shadowbench::groundtruth::testing
