#include "techniques/lod/shaded_pass.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

ShadedPass::ShadedPass() : program_("lod/instance.vert", "lod/shaded.frag") {}

void ShadedPass::draw(const LodFrame& frame, std::span<const LevelDraw> draws) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    program_.set("clipFromWorld", glm::mat4(frame.clipFromWorld())).set("light", glm::vec4(frame.light));
    program_.use();
    frame.drawer.draw(frame.chains, draws);
}

void ShadedPass::drawOpaque(const LodFrame& frame, const LodPicture& picture, std::span<const LevelDraw> draws) {
    const auto pass = frame.pass("opaque levels");
    picture.target.clearColour(0, lodBackground);
    picture.target.clearDepth(1);
    picture.target.bind();
    draw(frame, draws);
}

void ShadedPass::drawFading(const LodFrame& frame, const LodPicture& picture, std::span<const LevelDraw> draws) {
    if (draws.empty()) return;
    const auto pass = frame.pass("blended levels");
    picture.target.bind();
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw(frame, draws);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

} // namespace shadowbench::techniques
