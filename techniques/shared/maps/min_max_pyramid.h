// Min/max pyramid of a shadow map ("hierarchical shadow map", Guennebaud et al. 2006): bounds on the depths of a region from
// a few texels.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <vector>

namespace shadowbench::techniques {

/// Which texels the node (x, y) of level ℓ holds, along x: Apart: x·2^ℓ … (x + 1)·2^ℓ − 1; Shared: one more, with which the
/// next node begins, so that all corners of the squares between its texel centres and the next node's are known.
enum class NodeEnds { Apart, Shared };

/// A quadtree on a map of linear depths: the nodes of level ℓ ≥ 1 hold the greatest and the least 1 / depth of their texels.
/// Beside the map nothing is in the way. Read by shared/maps/min_max_pyramid.glsl.
class MinMaxPyramid {
public:
    /// `side`: texels per side of the map. `layers`: channels of its texels that get a pyramid each, at most 4.
    MinMaxPyramid(int side, NodeEnds ends, int layers = 1);

    /// From `depths`, metres of any sign, as the pass "min/max pyramid".
    void draw(const gl::Texture& depths, const Frame& frame);

    void bindTo(gl::Program& program) const;

    [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }

    /// Level 1 … `levels()` of the layer that was drawn last (RG32F: greatest, least).
    [[nodiscard]] const gl::Texture& level(int number) const { return levels_.at(static_cast<std::size_t>(number - 1)); }

private:
    void drawLayer(const gl::Texture& depths, int layer);

    int mapSide_, side_, layers_;
    std::vector<gl::Texture> levels_;
    gl::Texture atlas_; // all levels of all layers
    gl::Program first_, next_;
};

} // namespace shadowbench::techniques
