#include "scene/load/memory_need.h"

#include <algorithm>
#include <set>

namespace shadowbench {
namespace {

std::uint64_t coarsest(const Object& object) {
    std::size_t least = object.levels.front().mesh->triangles.size();
    for (const Level& level : object.levels) least = std::min(least, level.mesh->triangles.size());
    return least;
}

/// Of all levels and poses of all objects, each mesh counted once.
std::uint64_t bytesOfMeshes(const Scene& scene) {
    std::set<const Mesh*> counted;
    std::uint64_t bytes = 0;
    const auto add = [&](const Mesh& mesh) {
        if (counted.insert(&mesh).second) bytes += bytesOf(mesh);
    };
    for (const Object& object : scene.objects) {
        for (const Level& level : object.levels) add(*level.mesh);
        for (const auto& pose : object.poses) add(*pose);
    }
    return bytes;
}

} // namespace

std::uint64_t bytesOf(const Mesh& mesh) {
    return mesh.positions.size() * sizeof(glm::vec3) + mesh.triangles.size() * sizeof(glm::uvec3);
}

std::uint64_t leastMemory(const Scene& scene) {
    constexpr std::uint64_t ofATriangle = 3 * sizeof(glm::vec3); // corners in the world, as floats; most hold doubles
    // World position and its place a frame earlier, normal, id, depth; the truth's visibility, position, id, edge distance.
    constexpr std::uint64_t ofAPixel = 16 + 16 + 8 + 4 + 8 + 4 + 12 + 4 + 4;
    std::uint64_t triangles = 0;
    for (const Object& object : scene.objects) triangles += object.instances.size() * coarsest(object);
    const auto pixels = static_cast<std::uint64_t>(scene.size.x) * static_cast<std::uint64_t>(scene.size.y);
    return 2 * bytesOfMeshes(scene) + triangles * ofATriangle + pixels * ofAPixel;
}

} // namespace shadowbench
