// The pass that discrete switching and blending share: instances in their shaded colours.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/lod/level_drawer.h"

#include <span>

namespace shadowbench::techniques {

class ShadedPass {
public:
    ShadedPass();

    /// Clears the picture and draws opaque levels.
    void drawOpaque(const LodFrame& frame, const LodPicture& picture, std::span<const LevelDraw> draws);

    /// Draws levels over the picture, blended by their visibility, depth-tested but not written.
    void drawFading(const LodFrame& frame, const LodPicture& picture, std::span<const LevelDraw> draws);

private:
    void draw(const LodFrame& frame, std::span<const LevelDraw> draws);

    gl::Program program_;
};

} // namespace shadowbench::techniques
