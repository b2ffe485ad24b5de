// Formats of textures and targets by name.
#pragma once

#include <string>

namespace shadowbench::gpu {

/// "RGBA16F" of OpenGL's GL_RGBA16F; "" of 0. Throws InternalError for a format that the list lacks.
std::string formatName(unsigned format);

/// Of a pixel, as it lies in memory. Throws BadInput for another name.
int bytesOf(const std::string& format);

/// Whether channels are floats of 32 bits.
bool hasFullFloats(const std::string& format);

} // namespace shadowbench::gpu
