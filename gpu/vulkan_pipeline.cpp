#include "gpu/vulkan_pipeline.h"

#include "base/error.h"
#include "gpu/enumerants.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace shadowbench::gpu {
namespace {

constexpr VkPipelineCreateFlags keepStatistics =
    VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;

VkDescriptorType descriptorType(Resource resource) {
    switch (resource) {
    case Resource::SampledImage:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case Resource::Sampler:
        return VK_DESCRIPTOR_TYPE_SAMPLER;
    case Resource::Image:
        return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case Resource::StorageImage:
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case Resource::UniformTexels:
        return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case Resource::StorageTexels:
        return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    case Resource::UniformBuffer:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case Resource::StorageBuffer:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    throw InternalError("unknown kind of resource");
}

/// The bindings of all stages, set by set.
std::vector<std::vector<VkDescriptorSetLayoutBinding>> bindingsOf(const std::vector<Module>& modules) {
    std::map<std::pair<unsigned, unsigned>, Binding> all;
    for (const Module& module : modules)
        for (const Binding& binding : module.bindings) {
            Binding& known = all.try_emplace({binding.set, binding.number}, binding).first->second;
            if (known.resource != binding.resource)
                throw BadInput(fmt::format("binding {} of set {} holds two kinds of resources; give them a binding each",
                                           binding.number, binding.set));
            known.count = std::max(known.count, binding.count);
        }
    std::vector<std::vector<VkDescriptorSetLayoutBinding>> sets;
    for (const auto& [place, binding] : all) {
        if (place.first >= 32) throw BadInput(fmt::format("descriptor set {} is beyond the 32 that there are", place.first));
        sets.resize(std::max<std::size_t>(sets.size(), place.first + 1));
        sets[place.first].push_back(
            {place.second, descriptorType(binding.resource), binding.count, VK_SHADER_STAGE_ALL, nullptr});
    }
    return sets;
}

/// The state of a graphics pipeline as Vulkan has it: it points into itself.
struct GraphicsState {
    explicit GraphicsState(const State& state) {
        addVertices(state);
        addTargets(state);
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = topology(state.topology);
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = viewport.scissorCount = 1;
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.cullMode = culling(state.culledFace);
        raster.lineWidth = 1;
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = state.depthTest ? VK_TRUE : VK_FALSE;
        depth.depthWriteEnable = state.depthTest && state.depthWrite ? VK_TRUE : VK_FALSE;
        depth.depthCompareOp = comparison(state.depthFunction);
        depth.stencilTestEnable = state.stencilTest ? VK_TRUE : VK_FALSE;
        dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamic.dynamicStateCount = static_cast<std::uint32_t>(changing.size());
        dynamic.pDynamicStates = changing.data();
    }
    GraphicsState(const GraphicsState&) = delete;
    GraphicsState& operator=(const GraphicsState&) = delete;

    void addVertices(const State& state) {
        for (std::uint32_t i = 0; i < state.buffers.size(); ++i) {
            const VertexBuffer& buffer = state.buffers[i];
            const bool each = buffer.divisor == 0;
            buffers.push_back({i, buffer.stride, each ? VK_VERTEX_INPUT_RATE_VERTEX : VK_VERTEX_INPUT_RATE_INSTANCE});
            if (buffer.divisor > 1) divisors.push_back({i, buffer.divisor});
        }
        for (const Attribute& a : state.attributes)
            attributes.push_back({a.location, a.buffer, attributeFormat(a), a.offset});
        divisor.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT;
        divisor.vertexBindingDivisorCount = static_cast<std::uint32_t>(divisors.size());
        divisor.pVertexBindingDivisors = divisors.data();
        vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        if (!divisors.empty()) vertices.pNext = &divisor;
        vertices.vertexBindingDescriptionCount = static_cast<std::uint32_t>(buffers.size());
        vertices.pVertexBindingDescriptions = buffers.data();
        vertices.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
        vertices.pVertexAttributeDescriptions = attributes.data();
    }

    void addTargets(const State& state) {
        for (const ColourTarget& colour : state.colours) {
            VkPipelineColorBlendAttachmentState target{};
            target.colorWriteMask = colour.writeMask;
            if (colour.blends) {
                target.blendEnable = VK_TRUE;
                target.srcColorBlendFactor = target.srcAlphaBlendFactor = blendFactor(colour.source);
                target.dstColorBlendFactor = target.dstAlphaBlendFactor = blendFactor(colour.destination);
                target.colorBlendOp = target.alphaBlendOp = blendOperation(colour.equation);
            }
            targets.push_back(target);
            formats.push_back(textureFormat(colour.format));
        }
        blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend.logicOpEnable = state.logicOperation ? VK_TRUE : VK_FALSE;
        blend.logicOp = VK_LOGIC_OP_OR;
        blend.attachmentCount = static_cast<std::uint32_t>(targets.size());
        blend.pAttachments = targets.data();
        rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
        rendering.pColorAttachmentFormats = formats.data();
        rendering.depthAttachmentFormat = textureFormat(state.depthFormat);
        if (rendering.depthAttachmentFormat == VK_FORMAT_D32_SFLOAT_S8_UINT)
            rendering.stencilAttachmentFormat = rendering.depthAttachmentFormat;
    }

    std::vector<VkVertexInputBindingDescription> buffers;
    std::vector<VkVertexInputBindingDivisorDescriptionEXT> divisors;
    std::vector<VkVertexInputAttributeDescription> attributes;
    std::vector<VkPipelineColorBlendAttachmentState> targets;
    std::vector<VkFormat> formats;
    const std::vector<VkDynamicState> changing{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineVertexInputDivisorStateCreateInfoEXT divisor{};
    VkPipelineVertexInputStateCreateInfo vertices{};
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    VkPipelineViewportStateCreateInfo viewport{};
    VkPipelineRasterizationStateCreateInfo raster{};
    VkPipelineMultisampleStateCreateInfo samples{};
    VkPipelineDepthStencilStateCreateInfo depth{};
    VkPipelineColorBlendStateCreateInfo blend{};
    VkPipelineDynamicStateCreateInfo dynamic{};
    VkPipelineRenderingCreateInfo rendering{};
};

} // namespace

VulkanPipeline::VulkanPipeline(const Vulkan& vulkan, const Pipeline& pipeline,
                               const std::vector<std::vector<std::uint32_t>>& modules)
    : vulkan_(vulkan) {
    try {
        make(pipeline, modules);
    } catch (...) {
        release();
        throw;
    }
}

VulkanPipeline::~VulkanPipeline() { release(); }

void VulkanPipeline::release() {
    if (pipeline_ != VK_NULL_HANDLE) vulkan_.vkDestroyPipeline(vulkan_.device, pipeline_, nullptr);
    if (layout_ != VK_NULL_HANDLE) vulkan_.vkDestroyPipelineLayout(vulkan_.device, layout_, nullptr);
    for (VkDescriptorSetLayout set : sets_) vulkan_.vkDestroyDescriptorSetLayout(vulkan_.device, set, nullptr);
    for (const auto& stage : stages_) vulkan_.vkDestroyShaderModule(vulkan_.device, stage.module, nullptr);
}

void VulkanPipeline::make(const Pipeline& pipeline, const std::vector<std::vector<std::uint32_t>>& modules) {
    for (std::size_t i = 0; i < modules.size(); ++i) {
        read_.push_back(readModule(modules[i], pipeline.shaders[i].name));
        if (read_.back().stage != pipeline.shaders[i].stage)
            throw BadInput(fmt::format("{} is a {} shader, not a {} shader; give its file that ending",
                                       pipeline.shaders[i].name, name(read_.back().stage), name(pipeline.shaders[i].stage)));
    }
    makeLayout(read_);
    for (std::size_t i = 0; i < modules.size(); ++i) {
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = 4 * modules[i].size();
        info.pCode = modules[i].data();
        VkPipelineShaderStageCreateInfo stage{};
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.stage = stageFlag(read_[i].stage);
        stage.pName = read_[i].entry.c_str();
        require(vulkan_.vkCreateShaderModule(vulkan_.device, &info, nullptr, &stage.module), "making a module of Vulkan");
        stages_.push_back(stage);
    }
    if (read_.front().stage == Stage::Compute)
        makeCompute();
    else
        makeGraphics(pipeline.state);
}

void VulkanPipeline::makeLayout(const std::vector<Module>& modules) {
    for (const auto& bindings : bindingsOf(modules)) {
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(bindings.size());
        info.pBindings = bindings.data();
        VkDescriptorSetLayout set = VK_NULL_HANDLE;
        require(vulkan_.vkCreateDescriptorSetLayout(vulkan_.device, &info, nullptr, &set), "making a layout of descriptors");
        sets_.push_back(set);
    }
    const VkPushConstantRange constants{VK_SHADER_STAGE_ALL, 0, 256};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = static_cast<std::uint32_t>(sets_.size());
    info.pSetLayouts = sets_.data();
    info.pushConstantRangeCount = std::ranges::any_of(modules, &Module::pushConstants) ? 1 : 0;
    info.pPushConstantRanges = &constants;
    require(vulkan_.vkCreatePipelineLayout(vulkan_.device, &info, nullptr, &layout_), "making a layout of a pipeline");
}

void VulkanPipeline::makeCompute() {
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = keepStatistics;
    info.stage = stages_.front();
    info.layout = layout_;
    require(vulkan_.vkCreateComputePipelines(vulkan_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
            "compiling a compute pipeline");
}

void VulkanPipeline::makeGraphics(const State& state) {
    const GraphicsState all(state);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &all.rendering;
    info.flags = keepStatistics;
    info.stageCount = static_cast<std::uint32_t>(stages_.size());
    info.pStages = stages_.data();
    info.pVertexInputState = &all.vertices;
    info.pInputAssemblyState = &all.assembly;
    info.pViewportState = &all.viewport;
    info.pRasterizationState = &all.raster;
    info.pMultisampleState = &all.samples;
    info.pDepthStencilState = &all.depth;
    info.pColorBlendState = &all.blend;
    info.pDynamicState = &all.dynamic;
    info.layout = layout_;
    require(vulkan_.vkCreateGraphicsPipelines(vulkan_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
            "compiling a graphics pipeline");
}

} // namespace shadowbench::gpu
