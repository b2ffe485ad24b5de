// The G-buffer: what the camera sees, drawn once before any technique runs.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"

#include <glm/mat4x4.hpp>

namespace shadowbench::gl {

/// World position (RGBA32F, w = 1 where something is hit), geometric normal of the side that is seen (RGBA16F), surface id
/// (R32UI), depth-stencil (32-bit float + 8 bits), and, when something moves, each pixel's world position one frame earlier.
class GBuffer {
public:
    /// `border` extra pixels on both sides along x and y (overscan); pixel centres of the inner part stay where they are.
    explicit GBuffer(glm::ivec2 size, glm::ivec2 border = {0, 0});

    /// Draws the scene; `clipFromWorld` is the camera's, without the border.
    void draw(const SceneBuffers& scene, const glm::dmat4& clipFromWorld);

    [[nodiscard]] const Texture& position() const { return position_; }
    [[nodiscard]] const Texture& normal() const { return normal_; }
    [[nodiscard]] const Texture& id() const { return id_; }
    [[nodiscard]] const Texture& depthStencil() const { return depthStencil_; }
    [[nodiscard]] const Texture& previousPosition() const { return moving_ ? previousPosition_ : position_; }
    [[nodiscard]] glm::ivec2 size() const { return position_.size(); } // border included
    [[nodiscard]] glm::ivec2 border() const { return border_; }

    /// The projection that was drawn with: the camera's, widened by the border.
    [[nodiscard]] glm::dmat4 widened(const glm::dmat4& clipFromWorld) const;

    [[nodiscard]] Image<unsigned> readIds() const { return target_.readUint(2); }
    [[nodiscard]] Image<glm::vec4> readPositions() const { return target_.readVec4(0); }
    [[nodiscard]] Image<glm::vec4> readNormals() const { return target_.readVec4(1); }

private:
    glm::ivec2 border_;
    Texture position_, normal_, id_, depthStencil_, previousPosition_;
    RenderTarget target_, movingTarget_;
    Program still_, withMotion_;
    bool moving_ = false;
};

} // namespace shadowbench::gl
