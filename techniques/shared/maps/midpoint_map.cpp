#include "techniques/shared/maps/midpoint_map.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

MidpointMap::MidpointMap(int side, Lookup lookup, SecondDepth second)
    : kind_(second), first_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      second_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      middle_(gl::Format::Depth32F, {side, side},
              lookup == Lookup::CompareBilinear ? gl::Filter::Linear : gl::Filter::Nearest, gl::Wrap::BorderFar),
      firstTarget_{&first_}, secondTarget_{&second_}, middleTarget_{&middle_},
      nearest_("shared/maps/depth_map.vert", "gl/depth_only.frag"),
      peel_("shared/maps/depth_map.vert", "shared/maps/midpoint_peel.frag"),
      mean_(gl::Program::screen("shared/maps/midpoint_mean.frag")) {
    if (lookup != Lookup::Raw) middle_.compareDepth();
}

void MidpointMap::drawSurfaces(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        drawNearest(firstTarget_, nearest_, Faces::Both, light, frame.scene);
    }
    const auto pass = frame.pass("second depth");
    peel_.set("firstDepth", first_);
    drawNearest(secondTarget_, peel_, Faces::Both, light, frame.scene);
}

void MidpointMap::drawFaces(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        drawNearest(firstTarget_, nearest_, Faces::Front, light, frame.scene);
    }
    const auto pass = frame.pass("second depth");
    drawNearest(secondTarget_, nearest_, Faces::Back, light, frame.scene);
}

void MidpointMap::draw(const LightView& light, const Frame& frame) {
    if (kind_ == SecondDepth::Surface)
        drawSurfaces(light, frame);
    else
        drawFaces(light, frame);
    const auto pass = frame.pass("midpoint");
    mean_.set("firstDepth", first_).set("secondDepth", second_);
    middleTarget_.bind();
    mean_.drawScreenDepth();
}

std::vector<BarePass> MidpointMap::bare(const LightView& light) const {
    std::vector<BarePass> passes = ShadowMap::bare(light);
    passes.push_back(passes.front());
    passes.back().pass = "second depth";
    passes.back().source = "course, Bias: second surface";
    return passes;
}

void MidpointMap::drawNearest(const gl::RenderTarget& target, gl::Program& program, Faces faces, const LightView& light,
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

} // namespace shadowbench::techniques
