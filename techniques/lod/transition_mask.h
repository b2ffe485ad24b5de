// Which pixels see an instance in transition, at either of its levels: where transitions are looked at by metrics.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/lod/level_drawer.h"

namespace shadowbench::techniques {

class TransitionMask {
public:
    explicit TransitionMask(glm::ivec2 size);

    /// Surface ids: of the nearest instance of each pixel where that one is in transition, else 0.
    Image<unsigned> draw(const LodFrame& frame);

private:
    gl::Texture ids_, depth_;
    gl::RenderTarget target_;
    gl::Program program_;
};

} // namespace shadowbench::techniques
