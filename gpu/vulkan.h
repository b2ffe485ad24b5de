// Vulkan's functions that this program calls, for .cpp files of gpu/ only. The driver is opened while the program runs, and
// not through the loader: no layer that the user has installed is in the way.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

#include <string>

namespace shadowbench::gpu {

struct Vulkan {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
#define VULKAN_FUNCTION(name) PFN_##name name = nullptr;
#include "gpu/functions.inc"
#undef VULKAN_FUNCTION
};

/// A physical device of AMD's `family` that is not there, and the device on which pipelines compile for it. The environment
/// of this process becomes that of this family. Throws Inconclusive, saying what to install, where the driver is missing.
Vulkan openNullDevice(const std::string& family);
void createDevice(Vulkan& vulkan);
void close(Vulkan& vulkan);

/// "radv Mesa 22.3.6".
std::string driverVersion();

/// Throws InternalError naming `doing` unless `result` is success.
void require(VkResult result, const std::string& doing);

} // namespace shadowbench::gpu
