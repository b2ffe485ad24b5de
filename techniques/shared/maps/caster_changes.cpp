#include "techniques/shared/maps/caster_changes.h"

#include <algorithm>
#include <utility>

namespace shadowbench::techniques {

std::optional<std::vector<glm::dvec3>> CasterChanges::since(const Snapshot& snapshot) {
    std::map<std::uint32_t, Caster> now;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) now[placement.id] = {batch.mesh, placement.world};
    const auto before = std::exchange(casters_, std::move(now));
    const auto sameId = [](const auto& a, const auto& b) { return a.first == b.first; };
    if (!before || !std::ranges::equal(*before, *casters_, sameId)) return std::nullopt;

    std::vector<glm::dvec3> corners;
    for (const auto& [id, is] : *casters_) {
        const Caster& was = before->at(id);
        if (was.mesh == is.mesh && was.world == is.world) continue;
        for (const Caster* caster : {&was, &is})
            for (const glm::dvec3& corner : caster->mesh->bounds().corners())
                corners.emplace_back(caster->world * glm::dvec4(corner, 1));
    }
    return corners;
}

} // namespace shadowbench::techniques
