// Midpoint shadow map (Woo 1992; course, "Bias"; Zápotocký 4.4.2): the mean of first and second surface, so that neither is
// close to a receiver.
#pragma once

#include "techniques/shared/maps/depth_map.h"

namespace shadowbench::techniques {

/// What the nearest depth is averaged with. Surface: the next surface behind it, whichever way it faces (Woo; course).
/// BackFace: nearest front face and nearest back face (Zápotocký); where a mesh is open they belong to different objects.
enum class SecondDepth { Surface, BackFace };

/// Two square maps of depths in [0, 1], 1 where there is no such surface (beside the map 1 or more); midpoint() of
/// shared/maps/midpoint.glsl averages them.
class TwoDepths {
public:
    TwoDepths(int side, SecondDepth second);

    void draw(const LightView& light, const Frame& frame);

    [[nodiscard]] const gl::Texture& first() const { return first_; }
    [[nodiscard]] const gl::Texture& second() const { return second_; }

private:
    enum class Faces { Both, Front, Back };
    static void drawNearest(const gl::RenderTarget& target, gl::Program& program, Faces faces, const LightView& light,
                            const gl::SceneBuffers& scene);
    void drawSurfaces(const LightView& light, const Frame& frame);
    void drawBehindFirst(const LightView& light, const gl::SceneBuffers& scene);
    void drawFaces(const LightView& light, const Frame& frame);

    SecondDepth kind_;
    gl::Texture first_, second_; // the second one a colour where it is found by blending
    gl::RenderTarget firstTarget_;
    gl::Program nearest_, peel_;
};

/// The means in a map of their own: for filters, which look up every texel several times and may interpolate comparisons.
class MidpointMap final : public ShadowMap {
public:
    MidpointMap(int side, Lookup lookup, SecondDepth second = SecondDepth::Surface);

    /// Depth 1 where there is no second surface.
    void draw(const LightView& light, const Frame& frame) override;

    [[nodiscard]] const gl::Texture& texture() const override { return middle_; }

private:
    TwoDepths depths_;
    gl::Texture middle_;
    gl::RenderTarget middleTarget_;
    gl::Program mean_;
};

} // namespace shadowbench::techniques
