// A shadow map that can be filtered before the test: functions of depth instead of depth, averaged over the kernel once and
// read with few lookups (Scherzer 2.2.1). Variance, layered variance, convolution and exponential maps differ only in these
// functions, the basis, and in the test.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// How a box of `kernel` texels per side is averaged at the same cost whatever its width: over mipmapped texels of 2^level
/// texels each, `width` of them per side. The widest boxes at level 0 are 8 texels, all others are 4 to 8 of their level's.
struct BoxFilter {
    int level;
    double width;
};
BoxFilter boxFilter(int kernel);

/// The part of texel `offset` that lies in a box of `width` texels around the middle of texel 0.
double boxWeight(double width, int offset);

/// Texels that a map leaves free beside the scene, so that no box at the scene's rim reaches over the map's.
int freeRim(const BoxFilter& box);

/// Depth along the light's axis, 0 at the view's near and 1 at its far distance: dot(·, (p, 1)).
glm::dvec4 unitDepthFromWorld(const LightView& light);

/// `map`, `kernel`, `bias`, `factor` and `units`: the parameters of every technique over a prefiltered map.
std::vector<Parameter> prefilteredMapParameters();

/// What a texel stores.
struct Basis {
    std::string file; // fragment shader over filtered/basis.glsl
    gl::Defines defines;
    gl::Format format;
    int layers;
};

class PrefilteredMap {
public:
    /// `parameters` hold prefilteredMapParameters.
    PrefilteredMap(const Parameters& parameters, const Basis& basis);

    /// The basis's program, for uniforms of its own.
    gl::Program& basis() { return basis_; }

    /// Draws the frame's scene into a map of linear depth fitted to all of it, stores the basis of each depth and blurs it.
    void draw(const Frame& frame);

    /// Sets what filtered/prefiltered_map.glsl reads.
    void bindTo(gl::Program& resolve, const Frame& frame) const;

    /// `Technique::mapPoint` of the map drawn last, in texels of its depths.
    [[nodiscard]] std::optional<glm::dvec2> pointAt(const glm::dvec3& world) const {
        return texelAt(light_, world, glm::dvec2(depth_.side()));
    }

    /// The least that the frame drawn last needs: the casters, the box along both axes, mipmaps, and a filtered read of each
    /// layer for a pixel, which `source` asks for.
    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame, const std::string& source) const;

    /// Sets the uniforms of the unfiltered depths: linearDepth, depthRange, and the box's level and width.
    void bindDepthsTo(gl::Program& resolve) const;

private:
    void storeBasis(const Frame& frame);
    void blur(const Frame& frame);
    void filter(int layer);

    BoxFilter box_;
    LinearDepthMap depth_;
    LightView light_;
    gl::TextureArray stored_, filtered_;
    gl::Texture rows_; // filtered along x only
    gl::RenderTarget rowsTarget_;
    gl::Program basis_, alongX_, alongY_;
};

} // namespace shadowbench::techniques
