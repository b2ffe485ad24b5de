// Where casters that move are the nearest to the light (Scherzer 4.1.4).
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

/// The depths of the casters that have moved since the frame before alone. They are drawn as DepthMap draws all casters, so
/// that both maps hold the same bits where one of them is the nearest.
class MovingCasters {
public:
    /// `bias`: that of the map of all casters.
    MovingCasters(int side, Bias bias);

    /// As the pass "moving casters", where there are any.
    void draw(const LightView& light, const Frame& frame);

    [[nodiscard]] const gl::Texture& texture() const { return depth_; }

private:
    gl::Texture depth_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
    bool drawn_ = true; // the map is not empty
};

} // namespace shadowbench::techniques
