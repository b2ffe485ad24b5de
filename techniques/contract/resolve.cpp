#include "techniques/contract/resolve.h"

namespace shadowbench::techniques {

void resolve(const Frame& frame, std::initializer_list<const gl::Texture*> outputs, const gl::Program& program,
             std::string_view name) {
    const auto pass = frame.pass(name);
    const gl::RenderTarget target(outputs);
    target.bind();
    program.drawScreen();
}

} // namespace shadowbench::techniques
