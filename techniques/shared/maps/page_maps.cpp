#include "techniques/shared/maps/page_maps.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

PageMaps::PageMaps(int texels, int side, Bias bias)
    : texels_(texels), columns_(side / texels), depths_(gl::Format::Depth32F, glm::ivec2(columns_ * texels)),
      page_(gl::Format::Depth32F, glm::ivec2(texels)), target_{&page_},
      program_("shared/maps/depth_map.vert", "gl/depth_only.frag"), bias_(bias) {}

void PageMaps::draw(int slot, const LightView& view, const gl::SceneBuffers& scene, const std::vector<bool>& casters) {
    target_.clearDepth(1);
    target_.bind();
    {
        const CasterPass pass(program_, view, bias_);
        scene.draw(casters);
    }
    const glm::ivec2 corner = cornerOf(slot);
    glCopyImageSubData(page_.id(), GL_TEXTURE_2D, 0, 0, 0, 0, depths_.id(), GL_TEXTURE_2D, 0, corner.x, corner.y, 0, texels_,
                       texels_, 1);
}

} // namespace shadowbench::techniques
