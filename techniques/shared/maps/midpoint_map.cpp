#include "techniques/shared/maps/midpoint_map.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

TwoDepths::TwoDepths(int side, SecondDepth second)
    : kind_(second), first_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      second_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar), firstTarget_{&first_},
      secondTarget_{&second_}, nearest_("shared/maps/depth_map.vert", "gl/depth_only.frag"),
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
    peel_.set("firstDepth", first_);
    drawNearest(secondTarget_, peel_, Faces::Both, light, frame.scene);
}

void TwoDepths::drawFaces(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        drawNearest(firstTarget_, nearest_, Faces::Front, light, frame.scene);
    }
    const auto pass = frame.pass("second depth");
    drawNearest(secondTarget_, nearest_, Faces::Back, light, frame.scene);
}

std::vector<BarePass> TwoDepths::bare(const LightView& light) const {
    const int side = first_.size().x;
    std::vector<BarePass> passes(2, bareDepthMap("course, Shadow Mapping", side, light.clipFromWorld));
    passes.back().pass = "second depth";
    passes.back().source = "course, Bias: second surface";
    return passes;
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
