#include "techniques/shared/filters/back_projection.h"

#include "techniques/contract/resolve.h"

#include <cstddef>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {

Parameter flatParameter() {
    return {"flat", "0.02", RealRange{0, 1},
            "a square of texels is projected as one where its depths move its image by no more than this share of the "
            "light's half side",
            ""};
}

void setBackProjection(gl::Program& program, const Frame& frame, const LightView& view, const MinMaxPyramid& pyramid,
                       bool followPlane) {
    const Light& light = frame.snapshot.light;
    const glm::dvec2 halfSides = 0.5 * glm::dvec2(glm::length(light.u), glm::length(light.v));
    pyramid.bindTo(program);
    program.set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("mapFromWorld", mapFromWorld(view))
        .set("depthFromWorld", glm::vec4(view.depthFromWorld))
        .set("followPlane", followPlane ? 1.0F : 0.0F)
        .set("lightScale", glm::vec2(view.span / halfSides));
}

double meanOverReceivers(const Frame& frame, const gl::Program& program) {
    const Image<float> numbers = numbersOf(frame, program);
    const Image<unsigned> ids = frame.gbuffer.readIds();
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (ids[i] == 0) continue;
        sum += static_cast<double>(numbers[i]);
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

} // namespace shadowbench::techniques
