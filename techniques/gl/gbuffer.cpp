#include "techniques/gl/gbuffer.h"

#include "techniques/gl/api.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::gl {

GBuffer::GBuffer(glm::ivec2 size, glm::ivec2 border)
    : border_(border), position_(Format::RGBA32F, size + 2 * border), normal_(Format::RGBA16F, size + 2 * border),
      id_(Format::R32UI, size + 2 * border), depthStencil_(Format::Depth32FStencil8, size + 2 * border),
      previousPosition_(Format::RGBA32F, size + 2 * border), target_{&position_, &normal_, &id_, &depthStencil_},
      movingTarget_{&position_, &normal_, &id_, &previousPosition_, &depthStencil_},
      still_("gl/gbuffer.vert", "gl/gbuffer.frag"), withMotion_("gl/gbuffer.vert", "gl/gbuffer.frag", {{"MOTION", "1"}}) {}

glm::dmat4 GBuffer::widened(const glm::dmat4& clipFromWorld) const {
    const glm::dvec2 whole(size());
    const glm::dvec2 inner = whole - 2.0 * glm::dvec2(border_);
    return glm::scale(glm::dmat4(1), glm::dvec3(inner / whole, 1)) * clipFromWorld;
}

void GBuffer::draw(const SceneBuffers& scene, const glm::dmat4& clipFromWorld) {
    moving_ = scene.moving();
    const RenderTarget& target = moving_ ? movingTarget_ : target_;
    Program& program = moving_ ? withMotion_ : still_;
    target.clearColour(0, glm::vec4(0));
    target.clearColour(2, 0U);
    target.clearDepth(1);
    target.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    const glm::dvec4 eye = glm::inverse(clipFromWorld) * glm::dvec4(0, 0, 1, 0);
    program.set("clipFromWorld", glm::mat4(widened(clipFromWorld))).set("eye", glm::vec3(glm::dvec3(eye) / eye.w));
    program.use();
    if (moving_)
        scene.drawWithMotion();
    else
        scene.draw();
}

} // namespace shadowbench::gl
