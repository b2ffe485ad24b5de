#include "techniques/shared/maps/caster_changes.h"

#include <algorithm>
#include <utility>

namespace shadowbench::techniques {

std::optional<std::vector<glm::dvec3>> CasterChanges::since(const Snapshot& snapshot) {
    std::vector<Caster> now;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) now.push_back({batch.mesh, placement.world});
    const std::optional<std::vector<Caster>> before = std::exchange(casters_, std::move(now));
    const auto sameMesh = [](const Caster& a, const Caster& b) { return a.mesh == b.mesh; };
    if (!before || !std::ranges::equal(*before, *casters_, sameMesh)) return std::nullopt;

    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < before->size(); ++i) {
        const Caster &was = (*before)[i], &is = (*casters_)[i];
        if (was.world == is.world) continue;
        const auto box = is.mesh->bounds().corners();
        for (const glm::dmat4& world : {was.world, is.world})
            for (const glm::dvec3& corner : box) corners.emplace_back(world * glm::dvec4(corner, 1));
    }
    return corners;
}

} // namespace shadowbench::techniques
