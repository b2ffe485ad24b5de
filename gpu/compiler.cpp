#include "gpu/compiler.h"

#include "base/error.h"
#include "base/words.h"
#include "gpu/enumerants.h"
#include "gpu/spirv.h"
#include "gpu/vulkan.h"
#include "gpu/vulkan_pipeline.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench::gpu {
namespace {

constexpr std::array<Architecture, 4> known{{{"vega10", "GCN 5", "Radeon RX Vega 64"},
                                             {"navi10", "RDNA 1", "Radeon RX 5700 XT"},
                                             {"navi21", "RDNA 2", "Radeon RX 6800 XT"},
                                             {"gfx1100", "RDNA 3", "Radeon RX 7900 XTX"}}};

/// The SPIR-V of each shader, whichever way it was written.
std::vector<std::vector<std::uint32_t>> modulesOf(const Pipeline& pipeline) {
    std::vector<Shader> written;
    for (const Shader& shader : pipeline.shaders)
        if (!shader.text.empty()) written.push_back(shader);
    std::vector<std::vector<std::uint32_t>> translated, modules;
    if (!written.empty()) translated = toSpirv(written);
    auto next = translated.begin();
    for (const Shader& shader : pipeline.shaders) modules.push_back(shader.text.empty() ? shader.spirv : *next++);
    return modules;
}

StageFigures figuresOf(const Vulkan& vulkan, VkPipeline pipeline, std::uint32_t index,
                       const VkPipelineExecutablePropertiesKHR& properties) {
    VkPipelineExecutableInfoKHR which{};
    which.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
    which.pipeline = pipeline;
    which.executableIndex = index;
    std::uint32_t count = 0;
    require(vulkan.vkGetPipelineExecutableStatisticsKHR(vulkan.device, &which, &count, nullptr), "asking for statistics");
    VkPipelineExecutableStatisticKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    std::vector<VkPipelineExecutableStatisticKHR> statistics(count, empty);
    require(vulkan.vkGetPipelineExecutableStatisticsKHR(vulkan.device, &which, &count, statistics.data()),
            "asking for statistics");
    StageFigures figures{};
    for (const Stage stage : {Stage::Vertex, Stage::Fragment, Stage::Compute})
        if ((properties.stages & static_cast<VkShaderStageFlags>(stageFlag(stage))) != 0) figures.stage = stage;
    for (const VkPipelineExecutableStatisticKHR& each : statistics)
        if (!std::string_view(each.name).ends_with("ash"))              // "Hash", "Driver pipeline hash": no figures
            figures.statistics.emplace_back(each.name, each.value.u64); // RADV gives no other format
    figures.statistics.emplace_back("Subgroup size", properties.subgroupSize);
    return figures;
}

} // namespace

std::span<const Architecture> architectures() { return known; }

const Architecture& architectureNamed(std::string_view id) {
    const auto found = std::ranges::find(known, id, &Architecture::id);
    if (found != known.end()) return *found;
    std::vector<std::string> ids;
    for (const Architecture& architecture : known) ids.emplace_back(architecture.id);
    throwUnknownWord("architecture", id, ids);
}

std::string compilerVersion() {
    static const std::string version = driverVersion() + ", " + spirvCompiler();
    return version;
}

struct Compiler::Device {
    explicit Device(std::string_view family) : vulkan(openNullDevice(std::string(family))) { createDevice(vulkan); }
    ~Device() { close(vulkan); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    Vulkan vulkan;
};

Compiler::Compiler(const Architecture& architecture) : device_(std::make_unique<Device>(architecture.id)) {}
Compiler::~Compiler() = default;
Compiler::Compiler(Compiler&&) noexcept = default;

std::vector<StageFigures> Compiler::compile(const Pipeline& pipeline) const {
    const Vulkan& vulkan = device_->vulkan;
    const VulkanPipeline compiled(vulkan, pipeline, modulesOf(pipeline));
    VkPipelineInfoKHR which{};
    which.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
    which.pipeline = compiled.handle();
    std::uint32_t count = 0;
    require(vulkan.vkGetPipelineExecutablePropertiesKHR(vulkan.device, &which, &count, nullptr), "asking for executables");
    VkPipelineExecutablePropertiesKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    std::vector<VkPipelineExecutablePropertiesKHR> executables(count, empty);
    require(vulkan.vkGetPipelineExecutablePropertiesKHR(vulkan.device, &which, &count, executables.data()),
            "asking for executables");
    std::vector<StageFigures> figures;
    for (std::uint32_t i = 0; i < count; ++i) figures.push_back(figuresOf(vulkan, compiled.handle(), i, executables[i]));
    return figures;
}

} // namespace shadowbench::gpu
