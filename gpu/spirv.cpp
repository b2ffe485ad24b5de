#include "gpu/spirv.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <glslang/MachineIndependent/iomapper.h>
#include <glslang/MachineIndependent/localintermediate.h> // before the mapper, which includes less than it uses
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <memory>
#include <spirv-tools/optimizer.hpp>
#include <sstream>

namespace shadowbench::gpu {
namespace {

constexpr auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

EShLanguage languageOf(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return EShLangVertex;
    case Stage::Fragment:
        return EShLangFragment;
    case Stage::Compute:
        return EShLangCompute;
    }
    throw InternalError("unknown stage of a shader");
}

/// The first error of a log, whose lines are like "ERROR: FILE:12: 'x' : undeclared identifier", without its first word.
std::string firstError(const std::string& log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("ERROR: ")) return line.substr(7);
    return log;
}

void start() {
    static const bool ready = glslang::InitializeProcess();
    if (!ready) throw InternalError("glslang did not start");
}

std::unique_ptr<glslang::TShader> parsed(const Shader& source) {
    const EShLanguage language = languageOf(source.stage);
    auto shader = std::make_unique<glslang::TShader>(language);
    const char* text = source.text.c_str();
    const char* name = source.name.c_str();
    const int length = static_cast<int>(source.text.size());
    shader->setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader->setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader->setEnvInputVulkanRulesRelaxed(); // OpenGL's loose uniforms, gl_VertexID and gl_InstanceID
    shader->setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader->setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    shader->setAutoMapBindings(true);
    shader->setAutoMapLocations(true);
    if (!shader->parse(GetDefaultResources(), 450, false, messages))
        throw BadInput("compiling GLSL failed: " + firstError(shader->getInfoLog()));
    return shader;
}

/// What no function that is called names has no binding of its own: glslang numbers what is used alone.
void removeUnused(std::vector<std::uint32_t>& module) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    optimizer.RegisterPass(spvtools::CreateDeadVariableEliminationPass());
    if (!optimizer.Run(module.data(), module.size(), &module))
        throw InternalError("glslang made a module that cannot be read");
}

} // namespace

std::vector<std::vector<std::uint32_t>> toSpirv(const std::vector<Shader>& shaders) {
    start();
    std::vector<std::unique_ptr<glslang::TShader>> parts; // outlive the program
    glslang::TProgram program;
    for (const Shader& shader : shaders) program.addShader(parts.emplace_back(parsed(shader)).get());
    const auto linked = [&](bool good) {
        if (!good)
            throw BadInput(fmt::format("linking {} failed: {}", shaders.front().name, firstError(program.getInfoLog())));
    };
    linked(program.link(messages));
    glslang::TDefaultGlslIoResolver resolver(*program.getIntermediate(languageOf(shaders.front().stage)));
    glslang::TGlslIoMapper mapper;
    linked(program.mapIO(&resolver, &mapper));
    std::vector<std::vector<std::uint32_t>> modules;
    for (const Shader& shader : shaders) {
        std::vector<std::uint32_t>& module = modules.emplace_back();
        glslang::GlslangToSpv(*program.getIntermediate(languageOf(shader.stage)), module);
        removeUnused(module);
    }
    return modules;
}

std::string preprocessed(const Shader& shader) {
    start();
    const EShLanguage language = languageOf(shader.stage);
    glslang::TShader source(language);
    const char* text = shader.text.c_str();
    const char* name = shader.name.c_str();
    const int length = static_cast<int>(shader.text.size());
    source.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    glslang::TShader::ForbidIncluder includer;
    std::string result;
    if (!source.preprocess(GetDefaultResources(), 450, ECoreProfile, false, false, EShMsgDefault, &result, includer))
        throw BadInput("compiling GLSL failed: " + firstError(source.getInfoLog()));
    return result;
}

std::string spirvCompiler() {
    const glslang::Version version = glslang::GetVersion();
    return fmt::format("glslang {}.{}.{}", version.major, version.minor, version.patch);
}

} // namespace shadowbench::gpu
