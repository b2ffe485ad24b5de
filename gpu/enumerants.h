// From OpenGL's enumerants to Vulkan's; each throws InternalError for one that has no counterpart here.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/vulkan.h"

namespace shadowbench::gpu {

VkShaderStageFlagBits stageFlag(Stage stage);
VkFormat textureFormat(unsigned format);
VkFormat attributeFormat(const Attribute& attribute);
VkPrimitiveTopology topology(unsigned topology);
VkCompareOp comparison(unsigned function);
VkCullModeFlags culling(unsigned face); // 0: none
VkBlendFactor blendFactor(unsigned factor);
VkBlendOp blendOperation(unsigned equation);

} // namespace shadowbench::gpu
