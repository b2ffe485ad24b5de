// Skins of shadow maps: polygons across the depth discontinuities that one end of a linear light sees, drawn as the other
// end sees them (Heidrich, Brabec and Seidel 2000).
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <cstdint>

namespace shadowbench::techniques {

/// One end of a linear light.
struct LineEnd {
    explicit LineEnd(int side);
    LightView view;
    LinearDepthMap map; // without bias, which would move the skins' corners
    /// R32F: what a receiver in the penumbra that this end sees has of the light, in [0, 1]; 2 outside penumbrae.
    gl::Texture visibility;
};

/// The difference of two inverse depths (1/m) whose penumbra, cast from a light of this length, is a texel wide in the map.
double gapOfOneTexel(const LineEnd& end, double length);

class Skins {
public:
    /// `side`: texels of the maps.
    explicit Skins(int side);

    /// Counts from 0 again.
    void beginFrame();

    /// Fills the visibility map of `to` from the discontinuities in the depth map of `from`, which is `distance` metres
    /// away: as the passes "depth discontinuities" and "visibility map".
    void draw(const Frame& frame, const LineEnd& from, const LineEnd& to, double distance);

    /// Quads of the frame's skins.
    [[nodiscard]] std::uint32_t count() const;

private:
    void find(const LineEnd& from, double leastGap);
    void drawFound(const LineEnd& from, const LineEnd& to, double leastGap);

    gl::Program find_, draw_;
    gl::Buffer command_, cells_, total_;
};

} // namespace shadowbench::techniques
