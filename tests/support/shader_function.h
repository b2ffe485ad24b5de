// Runs a function of a shader over a list of inputs, so that it can be compared with its model.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"
#include "tests/support/stages.h"

#include <functional>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace shadowbench {

/// `expression` (of type vec4 or float) of the vec4 `x`, for each of the `inputs`, in a fragment shader that includes
/// `chunk` (a file under techniques/). `prepare` may set uniforms and bind storage blocks below 7.
inline std::vector<glm::vec4> evaluated(const std::string& chunk, const std::string& expression,
                                        const std::vector<glm::vec4>& inputs, const gl::Defines& defines = {},
                                        const std::function<void(gl::Program&)>& prepare = {}) {
    testContext();
    const std::string text = "#include \"" + chunk + "\"\n" +
                             "layout(std430, binding = 7) readonly buffer Inputs { vec4 inputs[]; };\n"
                             "out vec4 result;\n"
                             "void main() {\n"
                             "    vec4 x = inputs[int(gl_FragCoord.x)];\n"
                             "    result = vec4(" +
                             expression + ");\n}\n";
    gl::Program program = gl::Program::screenFromText("evaluated " + chunk, text, defines);
    const gl::Texture results(gl::Format::RGBA32F, {static_cast<int>(inputs.size()), 1}); // before others are bound
    if (prepare) prepare(program);
    gl::Buffer buffer;
    buffer.upload(inputs.data(), inputs.size() * sizeof(glm::vec4));
    buffer.bindStorage(7);
    const gl::RenderTarget target({&results});
    target.bind();
    program.drawScreen();
    const Image<glm::vec4> row = target.readVec4(0);
    gl::Context::current().check("evaluating " + expression);
    return {row.begin(), row.end()};
}

} // namespace shadowbench
