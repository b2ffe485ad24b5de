// A shadow map that also holds which surface each texel sees (Hourcade and Nicolas 1985): what tells a receiver from its own
// occluder without a bias.
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

class IdMap {
public:
    IdMap(int side, Bias bias);
    void draw(const LightView& light, const Frame& frame);

    /// RG32F: metres along the light's axis (`gl::nothingInTheWay` where there is nothing), surface id (0 there).
    [[nodiscard]] const gl::Texture& texture() const { return stored_; }
    [[nodiscard]] int side() const { return stored_.size().x; }

private:
    gl::Texture stored_, depth_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
};

} // namespace shadowbench::techniques
