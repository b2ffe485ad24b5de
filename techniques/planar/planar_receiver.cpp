#include "techniques/planar/planar_receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <map>

namespace shadowbench::techniques {
namespace {

constexpr double planeSteps = 1e4; // triangles whose normals and offsets agree to a ten-thousandth lie in one plane

using FlatFace = ReceiverFinder::FlatFace;

std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& i = mesh.triangles[triangle];
    return {glm::dvec3(mesh.positions[i.x]), glm::dvec3(mesh.positions[i.y]), glm::dvec3(mesh.positions[i.z])};
}

std::vector<FlatFace> flatFaces(const Mesh& mesh) {
    const Bounds box = mesh.bounds();
    const double extent = glm::distance(box.low, box.high);
    std::map<std::array<long, 4>, FlatFace> byPlane;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = cornersOf(mesh, t);
        const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a);
        const glm::dvec3 normal = glm::normalize(area);
        const glm::dvec4 plane(normal, glm::dot(normal, a) / extent);
        std::array<long, 4> key{};
        for (int i = 0; i < 4; ++i) key[static_cast<std::size_t>(i)] = std::lround(plane[i] * planeSteps);
        FlatFace& face = byPlane[key];
        face.triangles.push_back(t);
        face.area += area;
    }
    std::vector<FlatFace> faces;
    for (auto& [key, face] : byPlane)
        if (face.triangles.size() > 1) faces.push_back(std::move(face));
    return faces;
}

/// Whether the middle of every placement but `own` is in front of the plane.
bool isInFrontOfAllBut(std::uint32_t own, const glm::dvec4& plane, const Snapshot& snapshot) {
    for (const Batch& batch : snapshot.batches) {
        const glm::dvec3 middle = batch.mesh->bounds().centre();
        for (const Placement& placement : batch.placements) {
            if (placement.id == own) continue;
            if (glm::dot(plane, placement.world * glm::dvec4(middle, 1)) <= 0) return false;
        }
    }
    return true;
}

} // namespace

/// A face of a placement that faces the light.
struct ReceiverFinder::Candidate {
    const Mesh* mesh;
    const Placement* placement;
    const FlatFace* face;
    double area;
    glm::dvec4 plane;
};

std::vector<ReceiverFinder::Candidate> ReceiverFinder::facesTowardsLight(const Snapshot& snapshot,
                                                                         const glm::dvec4& light) const {
    std::vector<Candidate> candidates;
    for (const Batch& batch : snapshot.batches) {
        for (const Placement& placement : batch.placements) {
            // Area vectors transform by the cofactors of the placement's linear part.
            const glm::dmat3 linear(placement.world);
            const glm::dmat3 cofactors = glm::determinant(linear) * glm::inverseTranspose(linear);
            for (const FlatFace& face : meshes_.at(batch.mesh.get()).faces) {
                const glm::dvec3 area = cofactors * face.area;
                const glm::dvec3 normal = glm::normalize(area);
                const glm::dvec3 corner = cornersOf(*batch.mesh, face.triangles.front())[0];
                const glm::dvec3 point(placement.world * glm::dvec4(corner, 1));
                const glm::dvec4 plane(normal, -glm::dot(normal, point));
                if (glm::dot(plane, light) > 0)
                    candidates.push_back({batch.mesh.get(), &placement, &face, glm::length(area), plane});
            }
        }
    }
    return candidates;
}

std::optional<PlanarReceiver> ReceiverFinder::find(const Snapshot& snapshot, const Light& light) {
    for (const Batch& batch : snapshot.batches)
        if (!meshes_.contains(batch.mesh.get()))
            meshes_.emplace(batch.mesh.get(), MeshFaces{batch.mesh, flatFaces(*batch.mesh)});

    std::vector<Candidate> candidates = facesTowardsLight(snapshot, light.homogeneous());
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
    const auto chosen = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
        return isInFrontOfAllBut(c.placement->id, c.plane, snapshot);
    });
    if (chosen == candidates.end()) return std::nullopt;

    PlanarReceiver receiver{chosen->placement->id, chosen->plane, {}};
    for (const std::uint32_t t : chosen->face->triangles)
        for (const glm::dvec3& corner : cornersOf(*chosen->mesh, t))
            receiver.corners.emplace_back(chosen->placement->world * glm::dvec4(corner, 1));
    return receiver;
}

std::optional<PlanarReceiver> planarReceiver(const Snapshot& snapshot) {
    return ReceiverFinder().find(snapshot, snapshot.light.centreOnly());
}

std::optional<std::string> noPlanarReceiver(const Scene& scene) {
    if (planarReceiver(snapshot(scene, scene.timeline.still - 1))) return std::nullopt;
    return fmt::format("needs a planar receiver; {} has no flat face that light and all else are in front of", scene.id);
}

glm::dmat4 projectionOnto(const glm::dvec4& plane, const glm::dvec4& light) {
    return glm::dot(plane, light) * glm::dmat4(1) - glm::outerProduct(light, plane);
}

} // namespace shadowbench::techniques
