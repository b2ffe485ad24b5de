// Shadow map of linear depth in 32-bit floats (Scherzer 4.2), as a point sees it: metres along the light's axis,
// `gl::nothingInTheWay` where there is nothing. No depth lies before the near plane or, but for the bias, before the nearest
// corner of its triangle (shared/maps/caster_depth.glsl).
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

/// What a texel holds: the depth, negative where the caster moves (Scherzer 4.1.4; R32F), or the depth and the id of the
/// surface that it sees, 0 for none (Hourcade and Nicolas 1985; RG32F).
enum class Texel { Depth, DepthAndSurface };

class LinearDepthMap {
public:
    LinearDepthMap(int side, Bias bias, Texel texel = Texel::Depth);
    void draw(const LightView& light, const Frame& frame);

    [[nodiscard]] const gl::Texture& texture() const { return linear_; }
    [[nodiscard]] int side() const { return linear_.size().x; }

private:
    gl::Texture linear_, depth_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
};

/// 1 / depth at the far and at the near plane: what shared/maps/caster_depth.glsl reads.
glm::vec2 inverseRange(const LightView& light);

/// World from a texel of a map of linear depths that a perspective `light` has drawn: of (x · depth, y · depth, depth, 1),
/// x and y in [0, 1] over the map.
glm::dmat4 worldFromTexel(const LightView& light);

} // namespace shadowbench::techniques
