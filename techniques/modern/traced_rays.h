// A few rays a pixel to random points of an area light, through a tree over all triangles.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"

#include <string>

namespace shadowbench::techniques {

class TracedRays {
public:
    /// For the entries of techniques that do nothing else once.
    static constexpr const char* computed =
        "the tree over all triangles once, and again in each frame in which a caster moves; the rest in each frame";

    explicit TracedRays(const std::string& raysOfAPixel);

    /// The tree is that of other casters next time.
    void forget() { built_ = false; }

    /// Writes the share of each pixel's rays that are free (R32F), as passes "triangle tree", where a caster has moved, and
    /// `name`.
    void draw(const Frame& frame, const gl::Texture& share, const char* name);

private:
    void build(const Frame& frame);

    gl::Program program_;
    gl::Buffer nodes_, corners_;
    gl::BufferTexture nodeTexels_{nodes_, gl::BufferTexture::Texel::FourWords},
        cornerTexels_{corners_, gl::BufferTexture::Texel::FourFloats};
    float lift_ = 0; // metres that rays begin above their surface
    bool built_ = false;
};

} // namespace shadowbench::techniques
