#include "techniques/contract/bare.h"

namespace shadowbench::techniques {

std::uint64_t BarePass::tapsRead() const {
    std::uint64_t reads = 0;
    for (const Taps& group : taps) reads += static_cast<std::uint64_t>(group.count);
    return reads * static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
}

BarePass bareDepthMap(std::string source, int side, const glm::dmat4& clipFromWorld) {
    return {.pass = "depth map",
            .source = std::move(source),
            .size = glm::ivec2(side),
            .targets = {gl::Format::Depth32F},
            .casters = {{.clipFromWorld = clipFromWorld}}};
}

BarePass bareLookup(std::string_view pass, std::string source, glm::ivec2 imageSize, std::vector<Taps> taps) {
    taps.insert(taps.begin(), {gl::Format::RGBA32F, imageSize, Read::Pixel});
    return {.pass = pass,
            .source = std::move(source),
            .size = imageSize,
            .targets = {gl::Format::R32F},
            .taps = std::move(taps)};
}

} // namespace shadowbench::techniques
