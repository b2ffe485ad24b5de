// Shadow map of linear depth in 32-bit floats (Scherzer 4.2): metres along the light's axis, negative where the caster moves
// (4.1.4).
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

class LinearDepthMap {
public:
    LinearDepthMap(int side, Bias bias);
    void draw(const LightView& light, const Frame& frame);

    [[nodiscard]] const gl::Texture& texture() const { return linear_; }
    [[nodiscard]] int side() const { return linear_.size().x; }

private:
    gl::Texture linear_, depth_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
};

} // namespace shadowbench::techniques
