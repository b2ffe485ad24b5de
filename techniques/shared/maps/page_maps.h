// The maps of pages on the GPU.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/depth_map.h"

#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::techniques {

/// Slots for pages in a square texture. A page is drawn beside it and copied into its slot, for rasterisation depends, in
/// its last bits, on where a viewport lies: so a page has the same texels in every slot.
class PageMaps {
public:
    /// Pages of `texels`² in a texture of `side`².
    PageMaps(int texels, int side, Bias bias);

    /// Draws the placements `casters` (`castersIn`) of a frame's scene into a slot.
    void draw(int slot, const LightView& view, const gl::SceneBuffers& scene, const std::vector<bool>& casters);

    /// The first texel of a slot.
    [[nodiscard]] glm::ivec2 cornerOf(int slot) const { return texels_ * glm::ivec2(slot % columns_, slot / columns_); }

    [[nodiscard]] const gl::Texture& texture() const { return depths_; }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int slots() const { return columns_ * columns_; }

private:
    int texels_, columns_;
    gl::Texture depths_, page_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
};

} // namespace shadowbench::techniques
