// The least that a technique's steps need of the GPU, whoever programs them: vertices, fragments and texture reads ("taps")
// that its source asks for. The harness draws them as passes that do nothing else, beside the technique's own
// (docs/metrics.md, "Bare passes").
#pragma once

#include "techniques/gl/texture.h"

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// How a fragment reads a texture.
enum class Read {
    Pixel,          // the texel under it, of a texture as large as the target
    Nearest,        // texels around its place in the texture
    Linear,         // the same, each the mean of 2 × 2 by distance
    Compare,        // the same as Nearest, each compared with a depth
    CompareBilinear // the same as Linear
};

/// `count` reads of one texture by each fragment, side by side.
struct Taps {
    gl::Format format;
    glm::ivec2 size;
    Read read;
    int count = 1;
};

/// The scene's triangles, once, into a rectangle of a pass' target.
struct Casters {
    glm::dmat4 clipFromWorld;
    glm::ivec2 at{0}, size{0};            // of the rectangle, in texels; size 0: all of the target
    std::optional<glm::dvec4> plane = {}; // of the world; what has dot < 0 is clipped
    std::vector<bool> shown = {};         // placements (gl::SceneBuffers::draw); empty: all
};

/// A pass that clears its target; then it draws either casters, with a depth test where the target has depth, or one
/// fragment for each texel, which reads `taps` and writes their sum; or nothing.
struct BarePass {
    std::string_view pass;           // the technique's of which it is the least, or part of the least
    std::string source;              // what asks for it: section, equation
    glm::ivec2 size;                 // of the target
    std::vector<gl::Format> targets; // up to eight of colour, and one of depth at their end
    std::vector<Casters> casters = {};
    std::vector<Taps> taps = {};
    /// Draws geometry that is the technique's own, in place of all of the above: what the source asks for is the geometry,
    /// and no other way to draw it is known.
    std::function<void()> own = {};

    /// Texels that all its fragments read.
    [[nodiscard]] std::uint64_t tapsRead() const;
};

/// A map of nearest depths: the casters into it, nothing but depth is written.
BarePass bareDepthMap(std::string source, int side, const glm::dmat4& clipFromWorld);

/// A pass over the image whose pixels read their G-buffer position and `taps`, and write visibility.
BarePass bareLookup(std::string_view pass, std::string source, glm::ivec2 imageSize, std::vector<Taps> taps);

/// A step of a lookup that only some pixels take.
struct Branch {
    std::uint64_t pixels; // depends on the scene: counted as the source decides
    std::vector<Taps> taps;
};

/// The same of which some pixels read the branch's taps, too: a pass over as many, rounded down to four rows of the image,
/// and one over the others.
std::vector<BarePass> bareLookup(std::string_view pass, const std::string& source, glm::ivec2 imageSize,
                                 std::vector<Taps> taps, const Branch& branch);

/// Appends `more` to `passes`.
void append(std::vector<BarePass>& passes, std::vector<BarePass> more);

} // namespace shadowbench::techniques
