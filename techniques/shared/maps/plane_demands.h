// What the pixels of a frame ask of shadow maps over a light's image planes, found in a pass over the image.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "techniques/shared/maps/tile_choice.h"

#include <optional>
#include <vector>

namespace shadowbench::techniques {

class PlaneDemands {
public:
    /// Demands are weighed by the depth discontinuities of a first map of the whole planes.
    struct Discontinuity {
        float share; // of a pixel's weight that it has only beside one, in [0, 1]
        int side;    // of the first map, in texels
        Bias bias;   // of the first map
    };

    /// A pixel asks for at most `most` texels along a plane.
    explicit PlaneDemands(float most, const std::optional<Discontinuity>& discontinuity = {});

    /// Fits the planes to the frame and returns what its pixels ask of them, row by row, until it is called again. Pixels
    /// that ask for nothing get their visibility here: 1 where nothing is seen, 0 on surfaces that face away from the light.
    const std::vector<Demand>& of(const Frame& frame, const gl::Texture& visibility);

    /// Views of the planes of the last frame: one, or six.
    [[nodiscard]] const std::vector<LightView>& planes() const { return planes_; }

    /// Sets the uniforms of shared/maps/tile_of_pixel.glsl that concern the pixels of the last frame.
    void bindTo(gl::Program& program, const Frame& frame) const;

private:
    void drawWholePlanes(const Frame& frame);
    [[nodiscard]] std::vector<glm::mat4> planeFromWorld() const;

    std::optional<DepthAtlas> first_;
    gl::Program demand_;
    std::optional<gl::Texture> texture_;
    std::vector<Demand> demands_;
    std::vector<LightView> planes_;
};

} // namespace shadowbench::techniques
