#include "studies/shader_cost/given_shaders.h"

#include "base/error.h"
#include "base/files.h"
#include "gpu/module.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace shadowbench::shaders {
namespace {

std::optional<gpu::Stage> stageOfEnding(const std::filesystem::path& file) {
    constexpr std::array<std::pair<std::string_view, gpu::Stage>, 3> endings{
        {{".vert", gpu::Stage::Vertex}, {".frag", gpu::Stage::Fragment}, {".comp", gpu::Stage::Compute}}};
    const auto found =
        std::ranges::find(endings, file.extension().string(), &std::pair<std::string_view, gpu::Stage>::first);
    return found == endings.end() ? std::nullopt : std::optional(found->second);
}

gpu::Shader binaryShader(const std::string& file) {
    const std::string bytes = readFile(file);
    gpu::Shader shader{gpu::Stage::Vertex, file};
    shader.spirv.resize(bytes.size() / 4);
    std::memcpy(shader.spirv.data(), bytes.data(), 4 * shader.spirv.size());
    shader.stage = gpu::readModule(shader.spirv, file).stage;
    return shader;
}

gpu::Shader shaderOf(const std::string& file) {
    if (file.ends_with(".spv")) return binaryShader(file);
    const auto stage = stageOfEnding(file);
    if (!stage)
        throw BadInput(
            fmt::format("{} has not the ending of a shader: .vert, .frag or .comp of GLSL, .spv of SPIR-V", file));
    gpu::Shader shader{*stage, file, readFile(file)};
    if (shader.text.empty()) throw BadInput(file + " is empty; a shader begins with #version");
    return shader;
}

/// The file without the ending of its stage.
std::string programOf(const std::string& file) {
    std::filesystem::path path(file);
    if (path.extension() == ".spv") path.replace_extension();
    if (stageOfEnding(path)) path.replace_extension();
    return path.string();
}

} // namespace

std::vector<std::vector<gpu::Shader>> programsOf(const std::vector<std::string>& files) {
    std::vector<std::pair<std::string, std::vector<gpu::Shader>>> programs;
    for (const std::string& file : files) {
        const std::string name = programOf(file);
        gpu::Shader shader = shaderOf(file);
        auto found = std::ranges::find(programs, name, &std::pair<std::string, std::vector<gpu::Shader>>::first);
        // A compute shader is a program alone, whatever lies beside it.
        if (found == programs.end() || shader.stage == gpu::Stage::Compute)
            programs.push_back({shader.stage == gpu::Stage::Compute ? file : name, {std::move(shader)}});
        else
            found->second.push_back(std::move(shader));
    }
    std::vector<std::vector<gpu::Shader>> result;
    for (auto& [name, shaders] : programs) result.push_back(std::move(shaders));
    return result;
}

} // namespace shadowbench::shaders
