#include "studies/sweep/tessellate.h"

#include <algorithm>
#include <map>
#include <utility>

namespace shadowbench {
namespace {

Mesh quarteredOnce(const Mesh& mesh) {
    Mesh result{mesh.positions, {}, mesh.closed};
    result.triangles.reserve(4 * mesh.triangles.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [entry, isNew] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.positions.size()));
        if (isNew) result.positions.push_back(0.5F * mesh.positions[a] + 0.5F * mesh.positions[b]);
        return entry->second;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const std::uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
        for (const glm::uvec3& part :
             {glm::uvec3(t.x, a, c), glm::uvec3(a, t.y, b), glm::uvec3(c, b, t.z), glm::uvec3(a, b, c)})
            result.triangles.push_back(part);
    }
    return result;
}

} // namespace

Mesh quartered(const Mesh& mesh, int times) {
    Mesh result = mesh;
    for (int i = 0; i < times; ++i) result = quarteredOnce(result);
    return result;
}

} // namespace shadowbench
