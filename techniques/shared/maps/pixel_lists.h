// The irregular z-buffer (Aila and Laine 2004; Johnson, Mark and Burns 2004): pixels in lists, one for each cell of a grid
// over the light's view, and triangles that are tested against the pixels of all cells that their shadows may touch, in the
// order of work of Sintorn, Eisemann and Assarsson 2008 (Scherzer 2.3.5). Departures: the lists are linked; a triangle
// visits the cells of a box around its shadow; one that touches a large part of them all is tested against tiles of pixels
// in the image instead, and then against those of the tiles that it may shade.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace shadowbench::techniques {

class PixelLists {
public:
    /// `shade`: the compute shader with the technique's test of a triangle against a pixel, which includes
    /// shared/maps/cast_triangles.glsl. `grid`: cells per side. `words`: results a pixel. `lights`: corners of the light.
    /// `roundsOfLarge`: of all loops for each large triangle, at most, those that end a loop with them.
    PixelLists(std::string shade, gl::Defines defines, int grid, int words, int lights, int roundsOfLarge);

    /// Puts the frame's pixels into lists over `view`, as the pass "pixel lists"; all results become 0. `lights`,
    /// homogeneous, are the corners of the light, whose centre is the view's and whose plane lies across the view's axis; of
    /// a hard light, itself.
    void gather(const Frame& frame, const LightView& view, std::vector<glm::dvec4> lights);

    /// Tests the scene's triangles against the lists, as the pass "triangle tests"; `set` sets the uniforms of the
    /// technique's own. The results are then at the binding of shared/maps/pixel_lists.glsl.
    void cast(const Frame& frame, const std::function<void(gl::Program&)>& set);

    /// Tests of a triangle against a pixel in the frame that was cast last: they are made again, and change nothing.
    [[nodiscard]] std::uint64_t tests(const Frame& frame, const std::function<void(gl::Program&)>& set);

private:
    struct Casts {
        Casts(const std::string& shade, const gl::Defines& defines);
        gl::Program small, large;
    };
    void bind() const;
    void setGrid(gl::Program& program) const;
    void clearLarge(const Frame& frame);
    void castAll(const Frame& frame, Casts& casts, const std::function<void(gl::Program&)>& set);

    std::string shade_;
    gl::Defines defines_;
    int grid_;
    std::size_t words_;
    std::size_t largeAtOnce_; // triangles that a dispatch tests against all pixels
    LightView view_;          // of the frame rendered last
    std::vector<glm::dvec4> lights_;
    gl::Program bin_;
    Casts casts_;
    gl::Buffer heads_, nexts_, results_, large_;
    gl::BufferTexture headTexels_{heads_, gl::BufferTexture::Texel::Word},
        nextTexels_{nexts_, gl::BufferTexture::Texel::Word}, largeTriangles_{large_, gl::BufferTexture::Texel::FourFloats};
};

} // namespace shadowbench::techniques
