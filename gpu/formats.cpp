#include "gpu/formats.h"

#include "base/error.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench::gpu {
namespace {

struct NamedFormat {
    unsigned format;
    const char* name;
    int bytes;
};

constexpr std::array<NamedFormat, 14> formats{{{GL_R8, "R8", 1},
                                               {GL_RGBA8, "RGBA8", 4},
                                               {GL_R32F, "R32F", 4},
                                               {GL_RG16F, "RG16F", 4},
                                               {GL_RG32F, "RG32F", 8},
                                               {GL_RGBA16, "RGBA16", 8},
                                               {GL_RGBA16F, "RGBA16F", 8},
                                               {GL_RGBA32F, "RGBA32F", 16},
                                               {GL_R32UI, "R32UI", 4},
                                               {GL_RG32UI, "RG32UI", 8},
                                               {GL_RGBA32UI, "RGBA32UI", 16},
                                               {GL_RGBA32I, "RGBA32I", 16},
                                               {GL_DEPTH_COMPONENT32F, "Depth32F", 4},
                                               {GL_DEPTH32F_STENCIL8, "Depth32FStencil8", 8}}};

} // namespace

std::string formatName(unsigned format) {
    if (format == 0) return "";
    const auto found = std::ranges::find(formats, format, &NamedFormat::format);
    if (found == formats.end())
        throw InternalError(fmt::format("OpenGL's format {:#x} has no name in gpu/formats.cpp; add it", format));
    return found->name;
}

int bytesOf(const std::string& format) {
    const auto found = std::ranges::find_if(formats, [&](const NamedFormat& each) { return format == each.name; });
    if (found == formats.end())
        throw BadInput("there is no format of a target \"" + format + "\"; shader-cost writes the lines anew");
    return found->bytes;
}

bool hasFullFloats(const std::string& format) { return format.ends_with("32F") && !format.starts_with("Depth"); }

} // namespace shadowbench::gpu
