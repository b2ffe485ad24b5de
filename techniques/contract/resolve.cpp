#include "techniques/contract/resolve.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {

void resolve(const Frame& frame, std::initializer_list<const gl::Texture*> outputs, const gl::Program& program,
             std::string_view name) {
    const auto pass = frame.pass(name);
    const gl::RenderTarget target(outputs);
    target.bind();
    program.drawScreen();
}

Image<float> numbersOf(const Frame& frame, const gl::Program& program) {
    const gl::Texture numbers(gl::Format::R32F, frame.size);
    const gl::RenderTarget target({&numbers});
    target.bind();
    program.drawScreen();
    return target.readFloat(0);
}

glm::dmat4 imageFromClip(glm::ivec2 size) {
    const glm::dmat4 half = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * glm::dvec2(size), 1));
    return half * glm::translate(glm::dmat4(1), glm::dvec3(1, 1, 0));
}

} // namespace shadowbench::techniques
