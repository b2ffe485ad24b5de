#include "techniques/contract/resolve.h"

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

} // namespace shadowbench::techniques
