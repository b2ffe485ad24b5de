// Shadow map that is drawn as depth alone, as hardware draws fastest, and read as linear depth: metres along the light's
// axis (Scherzer 4.2). From a point, window depth z is linear in the reciprocal of linear depth d: with near and far
// distances n and f, d = n f / (f − z (f − n)).
//
// Precision: 32-bit floats store z in [½, 1) in steps of 2⁻²⁴, as 24-bit hardware does, so that storing moves d by up to
// d² (f − n) / (n f) · 2⁻²⁵, at most f² / n · 2⁻²⁵. Views are fitted with n ≥ f / 100 (`fitToPoints`), so that this stays
// below the constant bias of 64 units, which is f · 2⁻¹⁸.
#pragma once

#include "techniques/shared/maps/depth_map.h"

#include <glm/vec4.hpp>

namespace shadowbench::techniques {

/// What shared/maps/linearised_map.glsl makes linear depth of window depth z with: d = (x + y z) / (1 − z + z_ z) + w, where
/// (x, y, z_, w) is the result; `bias` metres are added.
glm::vec4 linearisation(const LightView& light, double bias);

/// The same for unit depth, which is 0 at the near and 1 at the far distance; `bias` is still in metres.
glm::vec4 unitLinearisation(const LightView& light, double bias);

/// Unit depth of a point of the world: dot(·, (p, 1)).
glm::dvec4 unitDepthFromWorld(const LightView& light);

/// The part of a bias that the depths are drawn with. The constant part is added where they are read: in metres it is the
/// same at every depth.
Bias drawnBias(Bias bias);

class LinearisedMap {
public:
    /// Of nearest depths.
    LinearisedMap(int side, Bias bias);

    /// As the pass "depth map".
    void draw(const LightView& light, const Frame& frame);

    /// Sets what shared/maps/linearised_map.glsl reads.
    void bindTo(gl::Program& program) const { bind(program, metres_); }

    /// The same for unit depths.
    void bindUnitTo(gl::Program& program) const { bind(program, unit_); }

    [[nodiscard]] int side() const { return depth_.side(); }

private:
    float units_; // of the constant bias
    DepthMap depth_;
    glm::vec4 metres_{0}, unit_{0};

    void bind(gl::Program& program, const glm::vec4& linearisation) const;
};

} // namespace shadowbench::techniques
