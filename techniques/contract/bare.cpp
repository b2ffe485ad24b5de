#include "techniques/contract/bare.h"

#include <algorithm>
#include <iterator>

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

std::vector<BarePass> bareLookup(std::string_view pass, const std::string& source, glm::ivec2 imageSize,
                                 std::vector<Taps> taps, const Branch& branch) {
    constexpr std::uint64_t block = 4; // rasterisers shade blocks of pixels: none lies on both sides
    const int rows = static_cast<int>(branch.pixels / (block * static_cast<std::uint64_t>(imageSize.x)) * block);
    std::vector<BarePass> parts(2, bareLookup(pass, source, imageSize, std::move(taps)));
    parts[0].size.y = rows;
    parts[0].taps.insert(parts[0].taps.end(), branch.taps.begin(), branch.taps.end());
    parts[1].size.y -= rows;
    std::erase_if(parts, [](const BarePass& part) { return part.size.y == 0; });
    return parts;
}

void append(std::vector<BarePass>& passes, std::vector<BarePass> more) {
    std::ranges::move(more, std::back_inserter(passes));
}

} // namespace shadowbench::techniques
