#include "studies/recommend/caster_groups.h"

#include "base/error.h"
#include "base/words.h"
#include "scene/meshes/import.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

namespace shadowbench::recommend {
namespace {

std::vector<std::string> namesWithLevels(const Scene& scene) {
    std::vector<std::string> names;
    for (const Object& object : scene.objects)
        if (object.levels.size() > 1) names.push_back(object.name);
    return names;
}

void requireLevels(const Scene& scene) {
    if (namesWithLevels(scene).empty())
        throw BadInput(fmt::format("no object of scene {} has levels of detail to cast at: choose a scene with lod or "
                                   "levels, such as windmills",
                                   scene.id));
}

void add(const CasterGroup& group, std::size_t level, Snapshot& snapshot) {
    if (group.levels[level]->triangles.empty()) return;
    snapshot.batches.push_back({group.levels[level], glm::vec3(0.8F), false, group.placements});
}

/// The groups of an object, one for each band that holds some of its placements.
std::vector<CasterGroup> grouped(const Object& object, const std::vector<Placement>& placements, const glm::dvec3& eye,
                                 const std::vector<double>& bands) {
    std::vector<CasterGroup> groups(bands.size() + 1);
    for (std::size_t band = 0; band < groups.size(); ++band) {
        groups[band].object = object.name;
        groups[band].from = band == 0 ? 0 : bands[band - 1];
        groups[band].until = band == bands.size() ? std::numeric_limits<double>::infinity() : bands[band];
        for (const Level& level : object.levels) groups[band].levels.push_back(level.mesh);
    }
    for (const Placement& placement : placements) {
        const double distance = glm::distance(eye, glm::dvec3(placement.world[3]));
        const auto band = std::ranges::lower_bound(bands, distance) - bands.begin();
        groups[static_cast<std::size_t>(band)].placements.push_back(placement);
    }
    std::erase_if(groups, [](const CasterGroup& group) { return group.placements.empty(); });
    return groups;
}

/// The object that `name` stands for.
Object& objectNamed(Scene& scene, const std::string& name) {
    const std::vector<std::string> names = namesWithLevels(scene);
    if (name.empty() && names.size() != 1)
        throw BadInput(fmt::format("levels are meant for one of the objects {}: name it, as in {}=600,300",
                                   fmt::join(names, ", "), names.front()));
    const std::string& wanted = name.empty() ? names.front() : name;
    const auto found = std::ranges::find_if(
        scene.objects, [&](const Object& object) { return object.levels.size() > 1 && object.name == wanted; });
    if (found == scene.objects.end())
        throw BadInput(fmt::format("no object with levels is named \"{}\"{}; scene {} has {}", wanted,
                                   didYouMean(wanted, names), scene.id, fmt::join(names, ", ")));
    return *found;
}

/// Levels with distances that only keep the order.
std::vector<Level> simplifiedChain(const std::shared_ptr<const Mesh>& finest, const std::vector<int>& triangles) {
    std::vector<Level> levels;
    for (const int wanted : triangles) {
        const bool whole = static_cast<std::size_t>(wanted) >= finest->triangles.size();
        auto mesh = whole ? finest : std::make_shared<const Mesh>(simplified(*finest, wanted));
        if (!levels.empty() && mesh->triangles.size() >= levels.back().mesh->triangles.size()) continue;
        levels.push_back({std::move(mesh), static_cast<double>(levels.size() + 1)});
    }
    levels.back().until = std::numeric_limits<double>::infinity();
    return levels;
}

/// Adds coarser levels, the last of which casts nothing.
void lengthen(std::vector<Level>& levels) {
    constexpr std::size_t step = 4, least = 4; // a tetrahedron is the least that encloses anything
    const auto last = [&] { return levels.back().mesh->triangles.size(); };
    for (std::size_t wanted = last() / step; wanted >= least; wanted /= step) {
        auto mesh = std::make_shared<const Mesh>(simplified(*levels.front().mesh, static_cast<int>(wanted)));
        if (!mesh->triangles.empty() && mesh->triangles.size() < last()) levels.push_back({std::move(mesh)});
    }
    levels.push_back({std::make_shared<const Mesh>()});
}

} // namespace

std::vector<double> ownBands(const Scene& scene) {
    std::set<double> bands;
    for (const Object& object : scene.objects)
        for (std::size_t level = 0; level + 1 < object.levels.size(); ++level) bands.insert(object.levels[level].until);
    return {bands.begin(), bands.end()};
}

Casters::Casters(const Scene& scene, int frame, const std::vector<double>& bands) : fixed_(snapshot(scene, frame)) {
    requireLevels(scene);
    if (!std::ranges::is_sorted(bands, std::less_equal<>()))
        throw BadInput(fmt::format("distance bands must grow: {:g}", fmt::join(bands, ", ")));

    std::map<std::uint32_t, Placement> placements; // by surface id: the objects' instances in order
    for (const Batch& batch : fixed_.batches)
        for (const Placement& placement : batch.placements) placements.emplace(placement.id, placement);

    std::uint32_t id = 0;
    for (const Object& object : scene.objects) {
        std::vector<Placement> own;
        for (std::size_t i = 0; i < object.instances.size(); ++i) own.push_back(placements.at(++id));
        if (object.levels.size() == 1) continue;
        for (const Placement& placement : own) withLevels_.insert(placement.id);
        for (CasterGroup& group : grouped(object, own, fixed_.camera.eye, bands)) groups_.push_back(std::move(group));
    }
    std::erase_if(fixed_.batches, [&](const Batch& batch) { return hasLevels(batch.placements.front().id); });
}

Costs Casters::costs() const {
    Costs costs(groups_.size());
    for (std::size_t group = 0; group < groups_.size(); ++group)
        for (std::size_t level = 0; level < groups_[group].levels.size(); ++level)
            costs[group].push_back(groups_[group].triangles(level));
    return costs;
}

Snapshot Casters::cast(const Levels& levels) const {
    Snapshot result = fixed_;
    for (std::size_t group = 0; group < groups_.size(); ++group) add(groups_[group], levels[group], result);
    return result;
}

Snapshot Casters::castAlone(std::size_t group, std::size_t level) const {
    Snapshot result = fixed_;
    add(groups_[group], level, result);
    return result;
}

Scene withChains(const Scene& scene, const Chains& chains) {
    Scene result = scene;
    if (!chains.empty()) requireLevels(scene);
    for (const auto& [name, triangles] : chains) {
        Object& object = objectNamed(result, name);
        if (triangles.size() < 2 || !std::ranges::is_sorted(triangles, std::greater_equal<>()) || triangles.back() < 4)
            throw BadInput(fmt::format("levels are at least 2 falling numbers of triangles, 4 or more, not {}",
                                       fmt::join(triangles, ", ")));
        if (!object.poses.empty())
            throw BadInput(fmt::format("{} deforms; levels of detail are of rigid meshes", object.name));
        object.levels = simplifiedChain(object.levels.front().mesh, triangles);
        if (object.levels.size() < 2)
            throw BadInput(fmt::format("the mesh of {} cannot be simplified below {} triangles", object.name,
                                       object.levels.front().mesh->triangles.size()));
    }
    for (Object& object : result.objects)
        if (object.levels.size() > 1 && !chains.contains(object.name) && !chains.contains("")) lengthen(object.levels);
    return result;
}

} // namespace shadowbench::recommend
