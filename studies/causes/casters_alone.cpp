#include "studies/causes/casters_alone.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace shadowbench::causes {
namespace {

/// A tetrahedron in a corner of `bounds`, inside it: no texel and no pixel is as small.
void addSpeck(Mesh& mesh, const Bounds& bounds, glm::bvec3 high) {
    constexpr double size = 1e-4; // of the bounds
    const glm::dvec3 corner(high.x ? bounds.high.x : bounds.low.x, high.y ? bounds.high.y : bounds.low.y,
                            high.z ? bounds.high.z : bounds.low.z);
    const glm::dvec3 inwards =
        size * (bounds.high - bounds.low) * glm::dvec3(high.x ? -1.0 : 1.0, high.y ? -1.0 : 1.0, high.z ? -1.0 : 1.0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(corner);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 end = corner;
        end[axis] += inwards[axis];
        mesh.positions.emplace_back(end);
    }
    const bool mirrored = inwards.x * inwards.y * inwards.z < 0;
    for (glm::uvec3 face : {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(0, 3, 2), glm::uvec3(1, 2, 3)}) {
        if (mirrored) std::swap(face.y, face.z);
        mesh.triangles.push_back(face + first);
    }
}

std::shared_ptr<const Mesh> specks(const Mesh& mesh) {
    auto result = std::make_shared<Mesh>();
    const Bounds bounds = mesh.bounds();
    for (int corner = 0; corner < 8; ++corner)
        addSpeck(*result, bounds, {(corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0});
    result->closed = mesh.closed;
    return result;
}

} // namespace

std::vector<std::vector<Batch>> castersAlone(const std::vector<Batch>& all, std::uint32_t ground, std::uint32_t most) {
    std::uint32_t last = ground;
    std::map<const Mesh*, std::shared_ptr<const Mesh>> inPlace;
    for (const Batch& batch : all) {
        inPlace.try_emplace(batch.mesh.get(), specks(*batch.mesh));
        for (const Placement& placement : batch.placements) last = std::max(last, placement.id);
    }
    if (last < ground + 2) return {};

    const std::uint32_t groups = std::min(most, last - ground);
    std::vector<std::vector<Batch>> result(groups + 1);
    for (std::uint32_t group = 0; group <= groups; ++group)
        for (const Batch& batch : all) {
            Batch shown = batch, hidden = batch;
            const auto stands = [&](const Placement& placement) {
                return placement.id <= ground || (placement.id - ground - 1) % groups + 1 == group;
            };
            hidden.mesh = inPlace.at(batch.mesh.get());
            std::erase_if(shown.placements, [&](const Placement& placement) { return !stands(placement); });
            std::erase_if(hidden.placements, stands);
            for (Batch& part : {std::ref(shown), std::ref(hidden)})
                if (!part.placements.empty()) result[group].push_back(std::move(part));
        }
    return result;
}

} // namespace shadowbench::causes
