// Midpoint shadow map (Woo 1992; Zápotocký 4.4.2): the mean of first and second surface, so that neither is close to a
// receiver.
#pragma once

#include "techniques/maps/depth_map.h"

namespace shadowbench::techniques {

class MidpointMap {
public:
    MidpointMap(int side, Lookup lookup);

    /// First surface, second surface by peeling the first, then their mean; depth 1 where there is no second one.
    void draw(const LightView& light, const gl::SceneBuffers& scene);

    [[nodiscard]] const gl::Texture& texture() const { return middle_; }

private:
    DepthMap first_;
    gl::Texture second_, middle_;
    gl::RenderTarget secondTarget_, middleTarget_;
    gl::Program peel_, mean_;
};

} // namespace shadowbench::techniques
