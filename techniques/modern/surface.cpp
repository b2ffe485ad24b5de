#include "techniques/modern/surface.h"

namespace shadowbench::techniques {

void bindSurfaces(const Frame& frame, gl::Program& program) {
    const glm::dmat4& clip = frame.clipFromWorld;
    program.set("positions", frame.gbuffer.position())
        .set("eyeDepth", glm::vec4(clip[0].w, clip[1].w, clip[2].w, clip[3].w));
    if (program.uses("normals")) program.set("normals", frame.gbuffer.normal());
}

void bindHistory(const Frame& frame, gl::Program& program, const gl::Texture& mean, const gl::Texture& moments, bool known) {
    program.set("previousPositions", frame.gbuffer.previousPosition())
        .set("previousMean", mean)
        .set("previousMoments", moments)
        .set("previousClipFromWorld", glm::mat4(frame.previousClipFromWorld))
        .set("hasHistory", known ? 1 : 0);
}

} // namespace shadowbench::techniques
