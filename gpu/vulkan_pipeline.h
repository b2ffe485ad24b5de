// A pipeline of Vulkan with all that it is made of.
#pragma once

#include "gpu/module.h"
#include "gpu/pipeline.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <vector>

namespace shadowbench::gpu {

class VulkanPipeline {
public:
    /// Compiles. `modules` are the SPIR-V of the pipeline's shaders, in their order. Throws BadInput where two resources
    /// share a binding.
    VulkanPipeline(const Vulkan& vulkan, const Pipeline& pipeline, const std::vector<std::vector<std::uint32_t>>& modules);
    ~VulkanPipeline();
    VulkanPipeline(const VulkanPipeline&) = delete;
    VulkanPipeline& operator=(const VulkanPipeline&) = delete;

    [[nodiscard]] VkPipeline handle() const { return pipeline_; }

private:
    void make(const Pipeline& pipeline, const std::vector<std::vector<std::uint32_t>>& modules);
    void makeLayout(const std::vector<Module>& modules);
    void makeCompute();
    void makeGraphics(const State& state);
    void release();

    const Vulkan& vulkan_;
    std::vector<Module> read_; // holds the names of entry points
    std::vector<VkPipelineShaderStageCreateInfo> stages_;
    std::vector<VkDescriptorSetLayout> sets_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace shadowbench::gpu
