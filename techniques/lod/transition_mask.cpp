#include "techniques/lod/transition_mask.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

TransitionMask::TransitionMask(glm::ivec2 size)
    : ids_(gl::Format::R32UI, size), depth_(gl::Format::Depth32F, size), target_{&ids_, &depth_},
      program_("lod/instance.vert", "lod/transition_mask.frag") {}

Image<unsigned> TransitionMask::draw(const LodFrame& frame) {
    std::vector<LevelDraw> draws;
    for (const LodInstance& instance : frame.instances) {
        const auto& selection = instance.selection;
        const std::uint32_t id = selection.inTransition() ? instance.id : 0;
        draws.push_back({&instance, selection.level, 1, id});
        if (id != 0) draws.push_back({&instance, selection.level + 1, 1, id});
    }
    target_.clearColour(0, 0U);
    target_.clearDepth(1);
    target_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    program_.set("clipFromWorld", glm::mat4(frame.clipFromWorld()));
    program_.use();
    frame.drawer.draw(frame.chains, draws);
    return target_.readUint(0);
}

} // namespace shadowbench::techniques
