#include "gpu/enumerants.h"

#include "base/error.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace shadowbench::gpu {
namespace {

template <typename Vulkan, std::size_t count>
using Pairs = std::array<std::pair<unsigned, Vulkan>, count>;

template <typename Vulkan, std::size_t count>
Vulkan counterpart(const Pairs<Vulkan, count>& pairs, unsigned enumerant, const char* what) {
    const auto found = std::ranges::find(pairs, enumerant, &std::pair<unsigned, Vulkan>::first);
    if (found != pairs.end()) return found->second;
    throw InternalError(
        fmt::format("OpenGL's {} {:#x} has no counterpart of Vulkan in gpu/enumerants.cpp; add it", what, enumerant));
}

constexpr Pairs<VkFormat, 15> formats{{{GL_R8, VK_FORMAT_R8_UNORM},
                                       {GL_RGBA8, VK_FORMAT_R8G8B8A8_UNORM},
                                       {GL_R32F, VK_FORMAT_R32_SFLOAT},
                                       {GL_RG16F, VK_FORMAT_R16G16_SFLOAT},
                                       {GL_RG32F, VK_FORMAT_R32G32_SFLOAT},
                                       {GL_RGBA16, VK_FORMAT_R16G16B16A16_UNORM},
                                       {GL_RGBA16F, VK_FORMAT_R16G16B16A16_SFLOAT},
                                       {GL_RGBA32F, VK_FORMAT_R32G32B32A32_SFLOAT},
                                       {GL_R32UI, VK_FORMAT_R32_UINT},
                                       {GL_RG32UI, VK_FORMAT_R32G32_UINT},
                                       {GL_RGBA32UI, VK_FORMAT_R32G32B32A32_UINT},
                                       {GL_RGBA32I, VK_FORMAT_R32G32B32A32_SINT},
                                       {GL_DEPTH_COMPONENT32F, VK_FORMAT_D32_SFLOAT},
                                       {GL_DEPTH32F_STENCIL8, VK_FORMAT_D32_SFLOAT_S8_UINT},
                                       {0, VK_FORMAT_UNDEFINED}}};

/// By the number of components.
constexpr std::array<std::pair<unsigned, std::array<VkFormat, 4>>, 3> attributeFormats{
    {{GL_FLOAT, {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}},
     {GL_UNSIGNED_INT, {VK_FORMAT_R32_UINT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32G32B32_UINT, VK_FORMAT_R32G32B32A32_UINT}},
     {GL_INT, {VK_FORMAT_R32_SINT, VK_FORMAT_R32G32_SINT, VK_FORMAT_R32G32B32_SINT, VK_FORMAT_R32G32B32A32_SINT}}}};

constexpr Pairs<VkPrimitiveTopology, 6> topologies{{{GL_POINTS, VK_PRIMITIVE_TOPOLOGY_POINT_LIST},
                                                    {GL_LINES, VK_PRIMITIVE_TOPOLOGY_LINE_LIST},
                                                    {GL_LINE_STRIP, VK_PRIMITIVE_TOPOLOGY_LINE_STRIP},
                                                    {GL_TRIANGLES, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST},
                                                    {GL_TRIANGLE_STRIP, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP},
                                                    {GL_TRIANGLE_FAN, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN}}};

constexpr Pairs<VkCompareOp, 9> comparisons{{{0, VK_COMPARE_OP_ALWAYS},
                                             {GL_NEVER, VK_COMPARE_OP_NEVER},
                                             {GL_LESS, VK_COMPARE_OP_LESS},
                                             {GL_EQUAL, VK_COMPARE_OP_EQUAL},
                                             {GL_LEQUAL, VK_COMPARE_OP_LESS_OR_EQUAL},
                                             {GL_GREATER, VK_COMPARE_OP_GREATER},
                                             {GL_NOTEQUAL, VK_COMPARE_OP_NOT_EQUAL},
                                             {GL_GEQUAL, VK_COMPARE_OP_GREATER_OR_EQUAL},
                                             {GL_ALWAYS, VK_COMPARE_OP_ALWAYS}}};

constexpr Pairs<VkBlendFactor, 6> factors{{{GL_ZERO, VK_BLEND_FACTOR_ZERO},
                                           {GL_ONE, VK_BLEND_FACTOR_ONE},
                                           {GL_SRC_ALPHA, VK_BLEND_FACTOR_SRC_ALPHA},
                                           {GL_ONE_MINUS_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA},
                                           {GL_DST_COLOR, VK_BLEND_FACTOR_DST_COLOR},
                                           {GL_SRC_COLOR, VK_BLEND_FACTOR_SRC_COLOR}}};

constexpr Pairs<VkBlendOp, 5> equations{{{GL_FUNC_ADD, VK_BLEND_OP_ADD},
                                         {GL_FUNC_SUBTRACT, VK_BLEND_OP_SUBTRACT},
                                         {GL_FUNC_REVERSE_SUBTRACT, VK_BLEND_OP_REVERSE_SUBTRACT},
                                         {GL_MIN, VK_BLEND_OP_MIN},
                                         {GL_MAX, VK_BLEND_OP_MAX}}};

} // namespace

VkShaderStageFlagBits stageFlag(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return VK_SHADER_STAGE_VERTEX_BIT;
    case Stage::Fragment:
        return VK_SHADER_STAGE_FRAGMENT_BIT;
    case Stage::Compute:
        return VK_SHADER_STAGE_COMPUTE_BIT;
    }
    throw InternalError("unknown stage of a shader");
}

VkFormat textureFormat(unsigned format) { return counterpart(formats, format, "texture format"); }

VkFormat attributeFormat(const Attribute& attribute) {
    for (const auto& [type, byComponents] : attributeFormats)
        if (type == attribute.type && attribute.integer == (type != GL_FLOAT))
            return byComponents.at(attribute.components - 1);
    throw InternalError(fmt::format("vertex attribute {} has type {:#x}, which gpu/enumerants.cpp does not know; add it",
                                    attribute.location, attribute.type));
}

VkPrimitiveTopology topology(unsigned topology) { return counterpart(topologies, topology, "topology"); }
VkCompareOp comparison(unsigned function) { return counterpart(comparisons, function, "comparison"); }

VkCullModeFlags culling(unsigned face) {
    if (face == 0) return VK_CULL_MODE_NONE;
    return face == GL_FRONT ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
}

VkBlendFactor blendFactor(unsigned factor) { return counterpart(factors, factor, "blend factor"); }
VkBlendOp blendOperation(unsigned equation) { return counterpart(equations, equation, "blend equation"); }

} // namespace shadowbench::gpu
