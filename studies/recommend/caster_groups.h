// Shadow casters with levels of detail, grouped by distance from the eye.
#pragma once

#include "scene/scene.h"
#include "studies/recommend/search.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace shadowbench::recommend {

/// The instances of one object in one distance band: they cast at one level.
struct CasterGroup {
    std::string object;                              // Object::name
    double from = 0, until = 0;                      // (from, until] metres between eye and instance origin
    std::vector<std::shared_ptr<const Mesh>> levels; // that they may cast at, finest first
    std::vector<Placement> placements;               // never empty

    /// Of all its placements together.
    [[nodiscard]] std::size_t triangles(std::size_t level) const {
        return levels[level]->triangles.size() * placements.size();
    }
};

/// The finite `until` distances of all objects with levels, ascending: where the scene itself changes levels.
std::vector<double> ownBands(const Scene& scene);

/// A frame's shadow casters. Objects with one level cast as they are; those with several in groups.
class Casters {
public:
    /// `bands`: ascending distances at which one band ends and the next begins. Throws BadInput when no object of the scene
    /// has levels of detail.
    Casters(const Scene& scene, int frame, const std::vector<double>& bands);

    /// In the order of the objects, then of the distances.
    [[nodiscard]] const std::vector<CasterGroup>& groups() const { return groups_; }

    /// Triangles of each group at each level.
    [[nodiscard]] Costs costs() const;

    [[nodiscard]] Levels finest() const { return Levels(groups_.size(), 0); }

    /// The frame with every group at its level. Surface ids are the scene's own.
    [[nodiscard]] Snapshot cast(const Levels& levels) const;

    /// The frame with one group only, and what has one level.
    [[nodiscard]] Snapshot castAlone(std::size_t group, std::size_t level) const;

    /// Whether the surface belongs to an object with levels.
    [[nodiscard]] bool hasLevels(std::uint32_t id) const { return withLevels_.contains(id); }

private:
    Snapshot fixed_; // what has one level
    std::vector<CasterGroup> groups_;
    std::set<std::uint32_t> withLevels_;
};

/// Levels by object name: triangles, finest first.
using Chains = std::map<std::string, std::vector<int>>;

/// The scene with the chains that `Casters` choose from. The levels of the named objects are replaced by simplifications of
/// their finest one: a number of at least its triangles stands for itself, and a level that the simplifier cannot make
/// smaller than the one before is left out. The chains of all others go on below their last level, with a quarter of the
/// triangles each time, down to no caster at all, so that none is chosen for want of a coarser one. Objects keep drawing
/// distances of no meaning. The name "" stands for the only object with levels. Throws BadInput for an unknown name and for
/// numbers that do not fall.
Scene withChains(const Scene& scene, const Chains& chains);

} // namespace shadowbench::recommend
