#include "gpu/vulkan.h"

#include "base/error.h"
#include "techniques/gl/library.h"

#include <array>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench::gpu {
namespace {

using GetProcedure = PFN_vkVoidFunction(VKAPI_PTR*)(VkInstance, const char*);

GetProcedure procedures() {
    static const gl::Library library("libvulkan_radeon.so", "SHADOWBENCH_LIBVULKAN_RADEON");
    if (!library.whyNot().empty())
        throw Inconclusive("compiling for graphics processors that are not there needs Mesa's Vulkan driver for AMD: " +
                           library.whyNot() + "; install it with: apt-get install mesa-vulkan-drivers");
    return library.function<GetProcedure>("vk_icdGetInstanceProcAddr");
}

/// What the user has set for other work would change the code.
void fixCompiler(const std::string& family) {
    setenv("RADV_FORCE_FAMILY", family.c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    for (const char* variable : {"RADV_DEBUG", "RADV_PERFTEST", "RADV_TEX_ANISO", "ACO_DEBUG", "NIR_DEBUG"})
        unsetenv(variable);
}

void createInstance(Vulkan& vulkan) {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(procedures()(VK_NULL_HANDLE, "vkCreateInstance"));
    require(create(&info, nullptr, &vulkan.instance), "making an instance of Vulkan");
}

} // namespace

void require(VkResult result, const std::string& doing) {
    if (result != VK_SUCCESS)
        throw InternalError(fmt::format("{} failed: Vulkan's error {}", doing, static_cast<int>(result)));
}

Vulkan openNullDevice(const std::string& family) {
    fixCompiler(family);
    Vulkan vulkan;
    createInstance(vulkan);
#define VULKAN_FUNCTION(name) vulkan.name = reinterpret_cast<PFN_##name>(procedures()(vulkan.instance, #name));
#include "gpu/functions.inc"
#undef VULKAN_FUNCTION
    std::uint32_t count = 1;
    const VkResult found = vulkan.vkEnumeratePhysicalDevices(vulkan.instance, &count, &vulkan.physicalDevice);
    if (found != VK_INCOMPLETE) require(found, "asking Mesa for a device of " + family);
    if (count == 0)
        throw Inconclusive("Mesa's Vulkan driver for AMD has no device of " + family + "; update mesa-vulkan-drivers");
    return vulkan;
}

void createDevice(Vulkan& vulkan) {
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{};
    statistics.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    statistics.pipelineExecutableInfo = VK_TRUE;
    VkPhysicalDeviceDynamicRenderingFeatures rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES;
    rendering.pNext = &statistics;
    rendering.dynamicRendering = VK_TRUE;
    VkPhysicalDeviceFeatures features{};
    features.shaderClipDistance = features.fragmentStoresAndAtomics = features.vertexPipelineStoresAndAtomics = VK_TRUE;
    features.shaderFloat64 = features.shaderInt64 = features.logicOp = features.independentBlend = VK_TRUE;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const std::array extensions{VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME,
                                VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME};
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &rendering;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = extensions.size();
    info.ppEnabledExtensionNames = extensions.data();
    info.pEnabledFeatures = &features;
    require(vulkan.vkCreateDevice(vulkan.physicalDevice, &info, nullptr, &vulkan.device), "making a device of Vulkan");
}

std::string driverVersion() {
    Vulkan vulkan = openNullDevice("navi21");
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vulkan.vkGetPhysicalDeviceProperties2(vulkan.physicalDevice, &properties);
    std::string version = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    close(vulkan);
    return version;
}

void close(Vulkan& vulkan) {
    if (vulkan.device != VK_NULL_HANDLE) vulkan.vkDestroyDevice(vulkan.device, nullptr);
    if (vulkan.instance != VK_NULL_HANDLE) vulkan.vkDestroyInstance(vulkan.instance, nullptr);
    vulkan = {};
}

} // namespace shadowbench::gpu
