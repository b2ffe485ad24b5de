// Occluders as seen from a light's centre, in layers: each layer a binary image of its own, of which the mean over any
// rectangle is read at the same cost, from summed areas. What is convolved with the image of a rectangular light that way:
// Soler and Sillion 1998; Eisemann and Décoret 2006.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"

#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// A bit of a texel each.
inline constexpr int mostLayers = 32;

/// Texels per side that the sums of 32 layers fit into 512 MiB with.
inline constexpr int widestLayer = 2048;

class OccluderLayers {
public:
    /// `program` draws casters (`CasterPass`) and writes the bits of the layers that hold a fragment.
    OccluderLayers(int side, gl::Program program);

    gl::Program& program() { return program_; }

    /// Draws the placements that are `shown` as seen from `light`, all layers in one pass named `name`.
    void draw(const LightView& light, const Frame& frame, const std::vector<bool>& shown, std::string_view name);

    /// Sums the areas of the first `layers` layers: the pass "summed areas".
    void sum(const Frame& frame, int layers);

    /// Sets the uniforms of shared/filters/occluder_layers.glsl. A disk counts as a rectangle of its area.
    void bindTo(gl::Program& resolve, const Light& light, const LightView& view) const;

    /// R32UI, bit i of a texel: an occluder of layer i.
    [[nodiscard]] const gl::Texture& bits() const { return bits_; }

private:
    gl::Texture bits_;
    gl::Buffer areas_;
    int summed_ = 0; // layers that areas_ has room for
    gl::Program program_, rows_, columns_;
};

} // namespace shadowbench::techniques
