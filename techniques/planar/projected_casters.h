// Casters flattened onto a plane by a light (Zápotocký 2.2), and the pixels that see the plane.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/planar/planar_receiver.h"

namespace shadowbench::techniques {

class ProjectedCasters {
public:
    ProjectedCasters();

    /// Draws the scene's casters between plane and `light` into the bound target, flattened onto the plane; every pixel that
    /// they cover gets `value`, whatever the depth.
    void draw(const gl::SceneBuffers& scene, const PlanarReceiver& receiver, const glm::dvec4& light,
              const glm::dmat4& clipFromWorld, float value);

    /// Sets the stencil of the pixels that see the receiver to 1, of all others to 0.
    void markReceiver(const Frame& frame, const PlanarReceiver& receiver, const gl::RenderTarget& target);

private:
    gl::Program project_, mark_;
};

/// How far from its plane, in metres, a surface of this receiver counts as being in it: below the rounding of 32-bit
/// positions.
float planeMargin(const PlanarReceiver& receiver);

} // namespace shadowbench::techniques
