#include "techniques/shared/maps/normal_offset.h"

namespace shadowbench::techniques {

gl::Defines normalOffsetDefines(Bias bias) {
    return bias.normalOffset != 0 ? gl::Defines{{"NORMAL_OFFSET", "1"}} : gl::Defines{};
}

void setNormalOffset(gl::Program& program, const Frame& frame, Bias bias, glm::ivec2 size) {
    if (bias.normalOffset == 0) return;
    program.set("normals", frame.gbuffer.normal()).set("normalOffset", bias.normalOffset).set("mapTexels", glm::vec2(size));
}

} // namespace shadowbench::techniques
