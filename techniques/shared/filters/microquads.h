// Bitmask soft shadows (Schwarz and Stamminger 2007; Scherzer 2.3.4): four neighbouring texel centres are the corners of a
// microquad, which occludes if all four lie before the receiver; the samples of the light that it hides are bits of a field.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/parameters.h"
#include "techniques/shared/filters/back_projection.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// `window`, `samples`, `bits` and `flat`.
std::vector<Parameter> microquadParameters();

/// Why `samples` and `bits` do not go together; nothing if they do.
std::optional<std::string> moreSamplesThanBits(const Parameters& parameters);

/// Of the pyramid over the map that microquads are made of, as `window` needs it.
NodeEnds nodeEnds(const Parameters& parameters);

/// Why such a technique has no answer for the scene's light; nothing if it has.
std::optional<std::string> lightWithoutSurface(const Scene& scene);

/// The pass that turns a map of linear depths into visibility (shared/filters/microquads.frag).
class Microquads {
public:
    /// `layers`: channels of the map, each of them a layer.
    Microquads(const Parameters& parameters, int layers);

    /// As the pass "resolve". `depths`: the map drawn with `view`, of which `pyramid` is.
    void resolve(const Frame& frame, const LightView& view, const gl::Texture& depths, const MinMaxPyramid& pyramid,
                 const gl::Texture& visibility);

    /// Mean number of quads that a pixel's receiver projects onto the light, counted by doing it again.
    [[nodiscard]] double quadsOf(const Frame& frame, const LightView& view, const gl::Texture& depths,
                                 const MinMaxPyramid& pyramid) const;

private:
    [[nodiscard]] gl::Program program(gl::Defines defines) const;

    /// A field of bits before any occluder: those that no sample of the light has are set.
    [[nodiscard]] std::vector<std::uint32_t> hiddenAtFirst(const Light& light) const;
    void set(gl::Program& program, const Frame& frame, const LightView& view, const gl::Texture& depths,
             const MinMaxPyramid& pyramid) const;

    std::string window_;
    int side_, bits_, layers_; // samples per side; bits of the field
    bool followPlane_;
    float flatness_;
    gl::Program resolve_;
    gl::Buffer outside_; // hiddenAtFirst
};

} // namespace shadowbench::techniques
