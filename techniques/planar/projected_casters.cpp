#include "techniques/planar/projected_casters.h"

#include "techniques/gl/api.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {

float planeMargin(const PlanarReceiver& receiver) {
    double farthest = 0;
    for (const glm::dvec3& corner : receiver.corners) farthest = std::max(farthest, glm::length(corner));
    constexpr double roundings = 16; // of single precision: position by matrix, then plane
    return static_cast<float>(roundings * farthest / (1 << 24));
}

ProjectedCasters::ProjectedCasters()
    : project_("planar/projected.vert", "planar/value.frag"), mark_(gl::Program::screen("planar/receiver.frag")) {}

void ProjectedCasters::draw(const gl::SceneBuffers& scene, const PlanarReceiver& receiver, const glm::dvec4& light,
                            const glm::dmat4& clipFromWorld, float value) {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP); // the receiver is in view wherever its shadow matters
    glEnable(GL_CLIP_DISTANCE0);
    glEnable(GL_CLIP_DISTANCE1);
    project_.set("clipFromWorld", glm::mat4(clipFromWorld * projectionOnto(receiver.plane, light)))
        .set("plane", glm::vec4(receiver.plane))
        .set("margin", planeMargin(receiver))
        .set("lightHeight", glm::vec2(glm::dot(receiver.plane, light), light.w))
        .set("value", value)
        .use();
    scene.draw();
    glDisable(GL_CLIP_DISTANCE1);
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_DEPTH_CLAMP);
}

void ProjectedCasters::markReceiver(const Frame& frame, const PlanarReceiver& receiver, const gl::RenderTarget& target) {
    const auto pass = frame.pass("receiver stencil");
    target.clearStencil();
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    mark_.set("positions", frame.gbuffer.position())
        .set("ids", frame.gbuffer.id())
        .set("receiverId", static_cast<int>(receiver.id))
        .set("plane", glm::vec4(receiver.plane))
        .set("margin", planeMargin(receiver));
    target.bind();
    mark_.drawScreen();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_STENCIL_TEST);
}

} // namespace shadowbench::techniques
