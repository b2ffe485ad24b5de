#include "harness/inspect/meshes.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace shadowbench::inspect {
namespace {

/// One instance, at rest, stands for all of its object.
glm::dmat4 firstPlace(const Object& object) { return placeAt(object, object.instances.front(), 0); }

std::string nameOf(const Object& object, std::size_t level) {
    if (!object.poses.empty()) return fmt::format("{}, the first of {} poses", object.name, object.poses.size());
    return object.levels.size() == 1 ? object.name : fmt::format("{}, level {}", object.name, level + 1);
}

} // namespace

std::vector<MeshReport> meshReports(const Scene& scene) {
    std::vector<MeshReport> reports;
    std::map<const Mesh*, MeshFaults> known;
    for (const Object& object : scene.objects)
        for (std::size_t level = 0; level < object.levels.size(); ++level) {
            const Mesh& mesh = *object.levels[level].mesh;
            const auto [faults, isNew] = known.try_emplace(&mesh);
            if (isNew) faults->second = faultsOf(mesh);
            reports.push_back({nameOf(object, level), object.instances.size(), mesh.triangles.size(),
                               transformed(mesh.bounds(), firstPlace(object)), mesh.closed, faults->second});
        }
    return reports;
}

FlatAreas flatAreas(const Scene& scene) {
    Bounds box;
    for (const Object& object : scene.objects)
        box.add(transformed(object.levels.front().mesh->bounds(), firstPlace(object)));
    constexpr double kFlat = 0.996;                               // cosine of 5°
    const double layer = 1e-3 * glm::distance(box.low, box.high); // what lies within it counts as one plane
    std::map<std::pair<int, long long>, double> areas;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = *object.levels.front().mesh;
        const glm::dmat4 place = firstPlace(object);
        for (const glm::uvec3& t : mesh.triangles) {
            std::array<glm::dvec3, 3> corners;
            for (int i = 0; i < 3; ++i)
                corners[static_cast<std::size_t>(i)] = glm::dvec3(place * glm::dvec4(glm::dvec3(mesh.positions[t[i]]), 1.0));
            const glm::dvec3 across = 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const double area = glm::length(across);
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(across[axis]) > kFlat * area) areas[{axis, std::llround(corners[0][axis] / layer)}] += area;
        }
    }
    FlatAreas largest;
    for (const auto& [plane, area] : areas) {
        if (!(area > largest.area[plane.first])) continue;
        largest.area[plane.first] = area;
        largest.place[plane.first] = static_cast<double>(plane.second) * layer;
    }
    return largest;
}

std::vector<std::string> namesOfInstances(const Scene& scene) {
    std::vector<std::string> names;
    for (const Object& object : scene.objects) names.insert(names.end(), object.instances.size(), object.name);
    return names;
}

} // namespace shadowbench::inspect
