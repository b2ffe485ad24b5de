// The irregular z-buffer (Aila and Laine 2004; Johnson, Mark and Burns 2004): pixels in lists, one for each cell of a grid
// over the light's view, and triangles that are tested against the pixels of all cells that their shadows may touch, in the
// order of work of Sintorn, Eisemann and Assarsson 2008 (Scherzer 2.3.5). Departures: the lists are linked; a triangle
// visits the cells of a box around its shadow.
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

namespace shadowbench::techniques {

class PixelLists {
public:
    /// `shade`: the compute shader with the technique's test of a triangle against a pixel, which includes
    /// shared/maps/cast_triangles.glsl. `grid`: cells per side. `words`: results a pixel. `roundsOfLarge`: of all loops of
    /// its shadeLarge() for each triangle, at most, those that end a loop with them.
    PixelLists(std::string shade, gl::Defines defines, int grid, int words, int roundsOfLarge);

    /// Puts the frame's pixels into lists over `view`, as the pass "pixel lists"; all results become 0. The light's centre
    /// is the view's; `u` and `v`, which lie in the light's plane and across the view's axis, are its sides, 0 for a hard
    /// light.
    void gather(const Frame& frame, const LightView& view, const glm::dvec3& u = {}, const glm::dvec3& v = {});

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
    glm::vec2 reach_{0};
    gl::Program bin_;
    Casts casts_;
    gl::Buffer heads_, nexts_, results_, large_;
    gl::BufferTexture largeTriangles_{large_};
};

} // namespace shadowbench::techniques
