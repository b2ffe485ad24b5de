#include "gpu/standalone.h"

#include "base/error.h"
#include "gpu/module.h"
#include "gpu/spirv.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace shadowbench::gpu {
namespace {

std::string typeOf(const Variable& variable) {
    constexpr std::string_view prefixes[] = {"", "i", "u"}, scalars[] = {"float", "int", "uint"};
    const auto scalar = static_cast<std::size_t>(variable.scalar);
    return variable.components == 1 ? std::string(scalars[scalar])
                                    : fmt::format("{}vec{}", prefixes[scalar], variable.components);
}

/// A vertex shader that writes all that a fragment shader reads, from attributes.
Shader sourceOf(const std::vector<Variable>& inputs) {
    std::string declared = "#version 450\nlayout(location = 15) in vec4 position;\n", body;
    for (const Variable& v : inputs) {
        if (v.location >= 15)
            throw BadInput("a fragment shader alone reads a location above 14; name its vertex shader, too");
        const char* flat = v.scalar == Scalar::Float ? "" : "flat ";
        declared += fmt::format("layout(location = {0}) in {1} a{0};\nlayout(location = {0}) {2}out {1} v{0};\n", v.location,
                                typeOf(v), flat);
        body += fmt::format("v{0} = a{0}; ", v.location);
    }
    return {Stage::Vertex, "", declared + "void main() { gl_Position = position; " + body + "}\n"};
}

/// A fragment shader that reads all that a vertex shader writes.
Shader sinkOf(const std::vector<Variable>& outputs) {
    constexpr std::string_view padding[] = {", 0, 0, 0", ", 0, 0", ", 0", ""};
    std::string declared = "#version 450\nlayout(location = 0) out vec4 colour;\n", body = "colour = vec4(0); ";
    for (const Variable& v : outputs) {
        const char* flat = v.scalar == Scalar::Float ? "" : "flat ";
        const Variable asFloat{v.location, Scalar::Float, v.components};
        declared += fmt::format("layout(location = {0}) {2}in {1} v{0};\n", v.location, typeOf(v), flat);
        body += fmt::format("colour += vec4({1}(v{0}){2}); ", v.location, typeOf(asFloat), padding[v.components - 1]);
    }
    return {Stage::Fragment, "", declared + "void main() { " + body + "}\n"};
}

unsigned typeOf(Scalar scalar) {
    if (scalar == Scalar::Float) return GL_FLOAT;
    return scalar == Scalar::Int ? GL_INT : GL_UNSIGNED_INT;
}

unsigned formatOf(Scalar scalar) {
    if (scalar == Scalar::Float) return GL_RGBA16F;
    return scalar == Scalar::Int ? GL_RGBA32I : GL_RGBA32UI;
}

State stateOf(const Module& vertex, const Module& fragment) {
    State state{.topology = GL_TRIANGLES};
    unsigned offset = 0;
    for (const Variable& input : vertex.inputs) {
        state.attributes.push_back({.location = input.location,
                                    .offset = offset,
                                    .type = typeOf(input.scalar),
                                    .components = input.components,
                                    .integer = input.scalar != Scalar::Float});
        offset += 4 * input.components;
    }
    if (offset > 0) state.buffers.push_back({offset, 0});
    for (const Variable& output : fragment.outputs) {
        if (output.location >= 8) throw BadInput("a fragment shader writes more than the 8 targets that there are");
        state.colours.resize(std::max<std::size_t>(state.colours.size(), output.location + 1));
        state.colours[output.location].format = formatOf(output.scalar);
    }
    state.depthFormat = GL_DEPTH_COMPONENT32F;
    state.depthTest = state.depthWrite = true;
    state.depthFunction = GL_LESS;
    return state;
}

/// Replaces GLSL by SPIR-V, all together, so that what goes between stages agrees.
void translate(std::vector<Shader>& shaders) {
    std::vector<Shader> written;
    std::ranges::copy_if(shaders, std::back_inserter(written), [](const Shader& s) { return !s.text.empty(); });
    if (written.empty()) return;
    auto modules = toSpirv(written);
    auto next = modules.begin();
    for (Shader& shader : shaders) {
        if (shader.text.empty()) continue;
        shader.spirv = std::move(*next++);
        shader.text.clear();
    }
}

} // namespace

Pipeline pipelineOf(std::vector<Shader> shaders) {
    std::ranges::sort(shaders, {}, &Shader::stage);
    if (std::ranges::adjacent_find(shaders, {}, &Shader::stage) != shaders.end())
        throw BadInput(
            fmt::format("{} and {} are of one stage; name them differently but for their ending, or one at a time",
                        shaders.at(0).name, shaders.at(1).name));
    translate(shaders);
    std::vector<Module> modules;
    for (const Shader& shader : shaders) modules.push_back(readModule(shader.spirv, shader.name));
    if (modules.front().stage == Stage::Compute && modules.size() > 1)
        throw BadInput(shaders.front().name + " is a compute shader, which is a pipeline alone");
    if (modules.front().stage == Stage::Compute) return {std::move(shaders), {}};
    if (modules.size() == 1) {
        const bool isVertex = modules.front().stage == Stage::Vertex;
        std::vector<Shader> other{isVertex ? sinkOf(modules.front().outputs) : sourceOf(modules.front().inputs)};
        translate(other);
        modules.insert(isVertex ? modules.end() : modules.begin(), readModule(other.front().spirv, "what stands beside it"));
        shaders.insert(isVertex ? shaders.end() : shaders.begin(), std::move(other.front()));
    }
    const State state = stateOf(modules.front(), modules.back());
    return {std::move(shaders), state};
}

} // namespace shadowbench::gpu
