// Triangles that techniques attach to the outlines of casters and draw from the light to make a penumbra: what smoothies and
// penumbra maps share.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/shared/casters/edge_meshes.h"
#include "techniques/shared/casters/outline.h"
#include "techniques/shared/maps/linearised_map.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// Why there is no round light that stands for the scene's (`lightRadius`): a line has no extent across.
std::optional<std::string> notRound(const Scene& scene);

/// Radius in metres of the round light that stands for an area light, as both papers take it: half the mean of its sides.
double lightRadius(const Light& light);

/// A point of a caster (object space), moved by `offset` (light space, metres), and a value that triangles interpolate.
struct AttachedVertex {
    glm::vec3 point;
    glm::vec3 offset;
    float value;
};

/// What triangles are made from: the outline of one placement.
struct AttachTo {
    const SeenOutline& outline;
    double depth; // of the middle of the placement's bounding box: metres from the light's plane, at least `nearest`
    double nearest, far;
};

class OutlineGeometry {
public:
    OutlineGeometry();

    /// Finds the outlines of all placements and appends three vertices for each triangle that `attach` makes of them.
    using Attach = std::function<void(const AttachTo&, std::vector<AttachedVertex>&)>;
    void build(const Frame& frame, const LightView& view, const Attach& attach);

    /// Draws them with a program of soft/outline_geometry.vert into the framebuffer that is bound, each channel of each
    /// texel keeping the least value. Points that are not moved lie where `map` has them, to the last bit.
    void draw(gl::Program& program, const LinearisedMap& map) const;

private:
    /// The triangles of one placement: a range of the buffer.
    struct Range {
        std::size_t first, count;
    };
    EdgeMeshes meshes_;
    LightView view_;
    glm::dmat4 lightFromWorld_{1};
    std::vector<Range> ranges_;
    gl::Buffer buffer_;
    gl::VertexArray layout_;
    bool bound_ = false;
};

/// `depthMapParameters` of techniques that test receivers as soft/outline_receiver.glsl does. The map has no bias: where a
/// caster is seen nearly edge-on, one by its slope would push it behind its own receiver, and no penumbra covers that texel.
std::vector<Parameter> receiverBiasParameters();

/// Sets the uniforms of soft/outline_receiver.glsl.
void bindOutlineReceiver(gl::Program& program, const Frame& frame, const LightView& view, const LinearisedMap& map,
                         Bias bias);

} // namespace shadowbench::techniques
