#include "techniques/shared/maps/midpoint_map.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

TwoDepths::TwoDepths(int side, SecondDepth second)
    : kind_(second), first_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      second_(second == SecondDepth::Surface ? gl::Format::R32F : gl::Format::Depth32F, {side, side}, gl::Filter::Nearest,
              gl::Wrap::BorderFar),
      firstTarget_{&first_}, nearest_("shared/maps/depth_map.vert", "gl/depth_only.frag"),
      peel_("shared/maps/depth_map.vert", "shared/maps/midpoint_peel.frag") {}

void TwoDepths::draw(const LightView& light, const Frame& frame) {
    if (kind_ == SecondDepth::Surface)
        drawSurfaces(light, frame);
    else
        drawFaces(light, frame);
}

void TwoDepths::drawSurfaces(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        drawNearest(firstTarget_, nearest_, Faces::Both, light, frame.scene);
    }
    const auto pass = frame.pass("second depth");
    drawBehindFirst(light, frame.scene);
}

/// The depth test rejects the first surfaces before anything is computed of them; of what is left blending keeps the
/// nearest.
void TwoDepths::drawBehindFirst(const LightView& light, const gl::SceneBuffers& scene) {
    const gl::RenderTarget target{&second_, &first_};
    target.clearColour(0, glm::vec4(1));
    target.bind();
    const CasterPass pass(peel_, light, Bias{});
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MIN);
    scene.draw();
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

void TwoDepths::drawFaces(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        drawNearest(firstTarget_, nearest_, Faces::Front, light, frame.scene);
    }
    const auto pass = frame.pass("second depth");
    drawNearest(gl::RenderTarget{&second_}, nearest_, Faces::Back, light, frame.scene);
}

void TwoDepths::drawNearest(const gl::RenderTarget& target, gl::Program& program, Faces faces, const LightView& light,
                            const gl::SceneBuffers& scene) {
    target.clearDepth(1);
    target.bind();
    const CasterPass pass(program, light, Bias{});
    if (faces != Faces::Both) {
        glEnable(GL_CULL_FACE);
        glCullFace(faces == Faces::Front ? GL_BACK : GL_FRONT);
    }
    scene.draw();
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
}

MidpointMap::MidpointMap(int side, Lookup lookup, SecondDepth second)
    : depths_(side, second),
      middle_(gl::Format::Depth32F, {side, side},
              lookup == Lookup::CompareBilinear ? gl::Filter::Linear : gl::Filter::Nearest, gl::Wrap::BorderFar),
      middleTarget_{&middle_}, mean_(gl::Program::screen("shared/maps/midpoint_mean.frag")) {
    if (lookup != Lookup::Raw) middle_.compareDepth();
}

void MidpointMap::draw(const LightView& light, const Frame& frame) {
    depths_.draw(light, frame);
    const auto pass = frame.pass("midpoint");
    mean_.set("firstDepth", depths_.first()).set("secondDepth", depths_.second());
    middleTarget_.bind();
    mean_.drawScreenDepth();
}

} // namespace shadowbench::techniques
