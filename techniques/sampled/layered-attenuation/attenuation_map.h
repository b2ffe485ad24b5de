// A layered attenuation map (Agrawala, Ramamoorthi, Heirich and Moll 2000): what many points of a light see, warped into
// the view from its centre, in lists of layers.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <cstddef>
#include <vector>

namespace shadowbench::techniques {

class AttenuationMap {
public:
    /// `side`: texels of the map. `oversampling`: texels of each light sample's own map for one of these, along each side.
    /// `samples`: how many, each a bit of a layer. `thickness`: of a layer, in widths of a texel.
    AttenuationMap(int side, int oversampling, int samples, double thickness);

    /// Draws a depth map from each of `points` of the light and warps it into the view from the light's centre, each as the
    /// passes "depth map" and "warped layers".
    void build(const Frame& frame, const std::vector<glm::dvec3>& points);

    /// Sets what shaders that include sampled/layered-attenuation/layers.glsl read.
    void bindTo(gl::Program& program) const;

    [[nodiscard]] const LightView& view() const { return view_; } // from the light's centre
    [[nodiscard]] int side() const { return side_; }

    /// Layers of each texel, row 0 at the bottom.
    [[nodiscard]] std::vector<int> depths() const;

private:
    void clear();
    void warp(const Frame& frame, const std::vector<glm::dvec3>& points);
    [[nodiscard]] std::size_t layersAskedFor() const;

    int side_, samples_;
    double thickness_;
    std::size_t capacity_; // layers
    LightView view_;
    LinearDepthMap map_;
    gl::Program warp_;
    gl::Buffer heads_, layers_;
};

/// SAMPLES and WORDS, for shaders that include sampled/layered-attenuation/layers.glsl.
gl::Defines attenuationDefines(int samples);

} // namespace shadowbench::techniques
