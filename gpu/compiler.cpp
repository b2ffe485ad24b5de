#include "gpu/compiler.h"

#include "base/error.h"
#include "base/words.h"
#include "gpu/enumerants.h"
#include "gpu/executed.h"
#include "gpu/marks.h"
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

/// The machine code as text; "" where the driver shows none.
std::string assemblyOf(const Vulkan& vulkan, const VkPipelineExecutableInfoKHR& which) {
    VkPipelineExecutableInternalRepresentationKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR;
    std::uint32_t count = 0;
    const auto ask = [&](VkPipelineExecutableInternalRepresentationKHR* all) {
        require(vulkan.vkGetPipelineExecutableInternalRepresentationsKHR(vulkan.device, &which, &count, all),
                "asking for machine code");
    };
    ask(nullptr);
    std::vector<VkPipelineExecutableInternalRepresentationKHR> all(count, empty);
    ask(all.data());
    const auto found = std::ranges::find_if(all, [](const auto& each) { return std::string_view(each.name) == "Assembly"; });
    if (found == all.end()) return "";
    std::string text(found->dataSize, '\0');
    found->pData = text.data();
    ask(all.data());
    return text;
}

StageFigures figuresOf(const Vulkan& vulkan, const VkPipelineExecutableInfoKHR& which,
                       const VkPipelineExecutablePropertiesKHR& properties) {
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
    explicit Device(std::string_view family) : isRdna(family != "vega10"), vulkan(openNullDevice(std::string(family))) {
        createDevice(vulkan);
    }
    ~Device() { close(vulkan); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    bool isRdna;
    Vulkan vulkan;
};

Compiler::Compiler(const Architecture& architecture) : device_(std::make_unique<Device>(architecture.id)) {}
Compiler::~Compiler() = default;
Compiler::Compiler(Compiler&&) noexcept = default;

struct Compiler::Compiled {
    StageFigures figures;
    std::string assembly;
};

std::vector<Compiler::Compiled> Compiler::compiled(const Pipeline& pipeline) const {
    const Vulkan& vulkan = device_->vulkan;
    const VulkanPipeline made(vulkan, pipeline, modulesOf(pipeline));
    VkPipelineInfoKHR all{};
    all.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
    all.pipeline = made.handle();
    std::uint32_t count = 0;
    require(vulkan.vkGetPipelineExecutablePropertiesKHR(vulkan.device, &all, &count, nullptr), "asking for executables");
    VkPipelineExecutablePropertiesKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    std::vector<VkPipelineExecutablePropertiesKHR> executables(count, empty);
    require(vulkan.vkGetPipelineExecutablePropertiesKHR(vulkan.device, &all, &count, executables.data()),
            "asking for executables");
    std::vector<Compiled> stages;
    for (std::uint32_t i = 0; i < count; ++i) {
        VkPipelineExecutableInfoKHR which{};
        which.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
        which.pipeline = made.handle();
        which.executableIndex = i;
        stages.push_back({figuresOf(vulkan, which, executables[i]), assemblyOf(vulkan, which)});
    }
    return stages;
}

std::vector<StageFigures> Compiler::compile(const Pipeline& pipeline) const {
    std::vector<StageFigures> figures;
    for (Compiled& stage : compiled(pipeline)) {
        // The driver counts two waves for each that a SIMD of RDNA holds.
        stage.figures.waves = static_cast<double>(stage.figures.of("Subgroups per SIMD")) / (device_->isRdna ? 2 : 1);
        stage.figures.guessed = guessedBusy(codeBlocks(stage.assembly));
        figures.push_back(std::move(stage.figures));
    }
    return figures;
}

std::vector<CodeBlock> Compiler::blocksOf(Pipeline pipeline, const std::string& text) const {
    Shader& counted = pipeline.shaders.back(); // vertex shaders come first
    counted.text = text;
    for (const Compiled& stage : compiled(pipeline))
        if (stage.figures.stage == counted.stage) return codeBlocks(stage.assembly);
    throw InternalError("the driver compiled " + counted.name + " without saying to what");
}

std::vector<Busy> Compiler::busyOfMarks(const Pipeline& pipeline) const {
    const Marked text = marked(pipeline.shaders.back());
    std::vector<CodeBlock> blocks = blocksOf(pipeline, placingText(text));
    if (text.hasInner && loopCount(blocks) > loopCount(blocksOf(pipeline, pipeline.shaders.back().text))) {
        std::vector<CodeBlock> unrolled = blocksOf(pipeline, placingText(text, false));
        if (loopCount(unrolled) < loopCount(blocks)) blocks = std::move(unrolled);
    }
    return gpu::busyOfMarks(blocks, text.marks);
}

} // namespace shadowbench::gpu
