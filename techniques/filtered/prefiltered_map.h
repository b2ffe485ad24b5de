// A shadow map that can be filtered before the test: functions of depth instead of depth, averaged over the kernel once and
// read with few lookups (Scherzer 2.2.1). Variance, layered variance, convolution and exponential maps differ only in these
// functions, the basis, and in the test.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/maps/linearised_map.h"

#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// How a box of `kernel` texels per side is averaged at the same cost whatever its width: over means of 2^level texels per
/// side, `width` of them per side. The widest boxes at level 0 are 8 texels, all others are 4 to 8 of their level's.
struct BoxFilter {
    int level;
    double width;
};
BoxFilter boxFilter(int kernel);

/// The part of texel `offset` that lies in a box of `width` texels around the middle of texel 0.
double boxWeight(double width, int offset);

/// Texels that a map leaves free beside the scene, so that no box at the scene's rim reaches over the map's.
int freeRim(const BoxFilter& box);

/// `map`, `kernel`, `bias`, `factor` and `units`: the parameters of every technique over a prefiltered map.
std::vector<Parameter> prefilteredMapParameters();

/// What a texel stores: up to four numbers in each of `textures` textures of one format.
struct Basis {
    std::string file; // compute shader over filtered/rows.glsl
    gl::Defines defines;
    gl::Format format;
    int textures;
};

class PrefilteredMap {
public:
    /// `parameters` hold prefilteredMapParameters.
    PrefilteredMap(const Parameters& parameters, const Basis& basis);

    /// The program of the basis, for uniforms of its own.
    gl::Program& basis() { return rowMeans_; }

    /// Draws the frame's scene into a map of depths fitted to all of it ("depth map"), and means of the basis of each depth
    /// over the box, with mipmaps ("blur").
    void draw(const Frame& frame);

    /// Sets what filtered/prefiltered_map.glsl reads.
    void bindTo(gl::Program& resolve, const Frame& frame) const;

    /// `Technique::mapPoint` of the map drawn last, in texels of its depths.
    [[nodiscard]] std::optional<glm::dvec2> pointAt(const glm::dvec3& world) const {
        return texelAt(light_, world, glm::dvec2(depth_.side()));
    }

    /// Sets the uniforms of the unfiltered depths (filtered/unit_depth.glsl), and the box's level and width.
    void bindDepthsTo(gl::Program& resolve) const;

private:
    void blurRows(int firstTexture);
    void blurColumns(const gl::Texture& rows, int layer);

    BoxFilter box_;
    LinearisedMap depth_;
    LightView light_;
    gl::Format format_;
    gl::TextureArray filtered_;
    std::vector<gl::Texture> rows_; // means along x, for as many of the textures as are drawn at once
    gl::Program rowMeans_, means_;
};

} // namespace shadowbench::techniques
