// Midpoint shadow map (Woo 1992; course, "Bias"; Zápotocký 4.4.2): the mean of first and second surface, so that neither is
// close to a receiver.
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

/// What the nearest depth is averaged with. Surface: the next surface behind it, whichever way it faces (Woo; course).
/// BackFace: nearest front face and nearest back face (Zápotocký); where a mesh is open they belong to different objects.
enum class SecondDepth { Surface, BackFace };

class MidpointMap final : public ShadowMap {
public:
    MidpointMap(int side, Lookup lookup, SecondDepth second = SecondDepth::Surface);

    /// Depth 1 where there is no second surface.
    void draw(const LightView& light, const Frame& frame) override;

    /// Both surfaces; the second's comparison with the first is left out.
    [[nodiscard]] std::vector<BarePass> bare(const LightView& light) const override;

    [[nodiscard]] const gl::Texture& texture() const override { return middle_; }

private:
    enum class Faces { Both, Front, Back };
    static void drawNearest(const gl::RenderTarget& target, gl::Program& program, Faces faces, const LightView& light,
                            const gl::SceneBuffers& scene);
    void drawSurfaces(const LightView& light, const Frame& frame);
    void drawFaces(const LightView& light, const Frame& frame);

    SecondDepth kind_;
    gl::Texture first_, second_, middle_;
    gl::RenderTarget firstTarget_, secondTarget_, middleTarget_;
    gl::Program nearest_, peel_, mean_;
};

} // namespace shadowbench::techniques
