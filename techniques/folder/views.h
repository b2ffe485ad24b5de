// The views of a technique folder's light, and the tiles of a map that hold what they see.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/folder/description.h"
#include "techniques/shared/maps/cascade_fit.h"
#include "techniques/shared/maps/depth_atlas.h"

#include <optional>
#include <span>
#include <vector>

namespace shadowbench::techniques {

class FolderViews {
public:
    FolderViews(const TechniqueFolder& folder, const Parameters& values);

    /// Fits them to the frame; `tile` is the side of one in the first map, in texels.
    void fit(const Frame& frame, int tile);

    /// Forgets the frame before.
    void reset();

    /// How many there are.
    [[nodiscard]] int count() const { return count_; }

    /// A tile for each, of a map that has `side`² texels together.
    [[nodiscard]] std::vector<Tile> tiles(int side) const;

    // Of the frame that was fitted last.
    [[nodiscard]] std::span<const LightView> views() const { return views_; }
    [[nodiscard]] const CascadeFit* cascades() const { return cascades_ ? &*cascades_ : nullptr; }

    /// The placements that cast into view `i`; null: all.
    [[nodiscard]] const std::vector<bool>* casters(std::size_t i) const { return casters_.empty() ? nullptr : &casters_[i]; }

    /// The view whose map a point is looked up in.
    [[nodiscard]] std::size_t viewAt(const glm::dvec3& world) const;

private:
    [[nodiscard]] LightView single(const Frame& frame) const;
    void fitCube(const Frame& frame);

    FolderView kind_;
    bool soft_; // the light as it is, and not its centre alone
    int count_ = 1;
    std::optional<CascadeFit> cascades_;
    glm::dvec3 light_{0};
    std::vector<LightView> views_;
    std::vector<std::vector<bool>> casters_; // of each view; empty: all
};

} // namespace shadowbench::techniques
