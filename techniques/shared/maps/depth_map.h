// The shadow map of Williams (course, "Shadow Mapping"): nearest depth per texel, and the bias that its finite texels need.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// One step of a 24-bit depth buffer: the unit of a constant bias.
inline constexpr double depthStep = 1.0 / (1 << 24);

/// What keeps a surface from shading itself. Depths are offset away from the light while the map is drawn (course, "Bias"):
/// factor · greatest depth slope per texel + units · depthStep. Or receivers are offset along their normals when they are
/// tested (shared/maps/normal_offset.h). A factor of 1 suffices on a plane for a lookup half a texel in x and in y from
/// where the depth was stored, 2 for one a whole texel away (docs/techniques.md, "Bias").
struct Bias {
    float factor = 0;
    float units = 0;
    float normalOffset = 0; // a factor, too
};

/// `map`: the side of a technique's one map, or of one with as many texels as all its maps together.
Parameter mapParameter(int defaultSide = 1024);

/// `map`, `bias`, `factor` and `units`: the parameters of every technique over a depth map.
std::vector<Parameter> depthMapParameters(int defaultSide = 1024);

/// A technique's own parameters, and after them `depthMapParameters()`.
std::vector<Parameter> withDepthMapParameters(std::vector<Parameter> own);

/// Adds `bias=normal-offset`, for a technique that tests receivers through shared/maps/tested_point.glsl.
std::vector<Parameter> withNormalOffset(std::vector<Parameter> parameters);

Bias biasFrom(const Parameters& parameters);

/// Whether texels beside the receiver's own are compared with the receiver's plane: a bias that follows slopes covers one
/// texel, and a filter reaches farther.
bool followsPlane(const Parameters& parameters);

/// Compare: sampled through sampler2DShadow with 2×2 interpolated comparisons if `Filter::Linear`; Raw: depths read as
/// numbers.
enum class Lookup { Compare, CompareBilinear, Raw };

/// A square map of depths in [0, 1] that receivers are tested against.
class ShadowMap {
public:
    virtual ~ShadowMap() = default;

    /// Draws the frame's scene as seen from the light. Occluders between the light and the near plane are kept, at depth 0.
    virtual void draw(const LightView& light, const Frame& frame) = 0;

    [[nodiscard]] virtual const gl::Texture& texture() const = 0;
};

/// Fragments of casters that a map's drawing rasterises, and those of them that it writes.
struct CasterFragments {
    std::uint64_t rasterised = 0, written = 0;
};

/// Nearest depths.
class DepthMap final : public ShadowMap {
public:
    /// `cutsCasters`: what lies behind the view's casterPlane is not drawn.
    DepthMap(int side, Bias bias, Lookup lookup, bool cutsCasters = false);

    void draw(const LightView& light, const Frame& frame) override;

    /// Counted by drawing the same map again.
    [[nodiscard]] CasterFragments fragments(const LightView& light, const Frame& frame) const;

    [[nodiscard]] const gl::Texture& texture() const override { return depth_; }
    [[nodiscard]] int side() const { return depth_.size().x; }

private:
    gl::Texture depth_;
    gl::RenderTarget target_;
    static gl::Program program(bool cutsCasters);

    bool cutsCasters_;
    gl::Program program_;
    Bias bias_;
};

/// Map space: x, y and depth in [0, 1] where clip space has [−1, 1].
glm::dmat4 mapFromClip();
glm::mat4 mapFromWorld(const LightView& light);

/// GL state of every pass that draws casters into a map: depth before the near plane is clamped; slope bias, and the step of
/// the rasteriser's grid without which a caster seen edge-on may lie anywhere (shared/maps/caster_depth.glsl).
class CasterState {
public:
    explicit CasterState(Bias bias);
    ~CasterState();
    CasterState(const CasterState&) = delete;
    CasterState& operator=(const CasterState&) = delete;
};

/// The same with the uniforms of a projective map; what lies behind the light is clipped.
class CasterPass {
public:
    CasterPass(gl::Program& program, const LightView& light, Bias bias);
    ~CasterPass();
    CasterPass(const CasterPass&) = delete;
    CasterPass& operator=(const CasterPass&) = delete;

private:
    CasterState state_;
};

} // namespace shadowbench::techniques
