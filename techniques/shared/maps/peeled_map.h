// Depth-peeled shadow map: the nearest surface of each texel, and surfaces behind it (Scherzer 2.3.4, Bavoil et al. 2008).
#pragma once

#include "techniques/shared/maps/depth_map.h"

#include <array>

namespace shadowbench::techniques {

/// Linear depths in metres along the light's axis, a layer in each channel (RGBA32F), nearest first; `nothingInTheWay` where
/// there are no more; negative where the caster moves. The first layer holds all surfaces; those behind it hold only
/// surfaces that face the light, so that what comes after the top of a closed mesh is the next mesh and not its own lower
/// side.
class PeeledMap {
public:
    static constexpr int most = 4;

    /// `layers`: 1 … `most`.
    PeeledMap(int side, int layers, Bias bias);

    /// As the pass "depth map", and one "depth peeling" for each further layer.
    void draw(const LightView& light, const Frame& frame);

    [[nodiscard]] const gl::Texture& texture() const { return layered_; }

private:
    void drawLayer(gl::Program& program, int layer, const LightView& light, const gl::SceneBuffers& scene);

    int layers_;
    gl::Texture layered_;
    std::array<gl::Texture, 2> depths_; // of this layer and the one before, in turn
    gl::Program nearest_, peel_;
    Bias bias_;
};

} // namespace shadowbench::techniques
