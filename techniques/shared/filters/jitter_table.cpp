#include "techniques/shared/filters/jitter_table.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <string>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr std::uint32_t sets = jitterBlock * jitterBlock;

} // namespace

JitterTable::JitterTable(const JitterGrid& grid, std::uint32_t first)
    : table_(gl::Format::RGBA32F, {static_cast<int>(sets), grid.taps() / 2}) {
    std::vector<glm::vec2> texels(sets * static_cast<std::size_t>(grid.taps()));
    for (std::uint32_t set = 0; set < sets; ++set) {
        const std::vector<glm::vec2> taps = jitteredTaps(grid, first + set);
        for (std::size_t i = 0; i < taps.size(); ++i) texels[2 * (sets * (i / 2) + set) + i % 2] = taps[i];
    }
    glBindTexture(GL_TEXTURE_2D, table_.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, table_.size().x, table_.size().y, GL_RGBA, GL_FLOAT, texels.data());
    gl::Context::current().check("uploading a table of jittered taps");
}

gl::Defines JitterTable::defines() { return {{"JITTER_BLOCK", std::to_string(jitterBlock)}}; }

glm::vec2 JitterTable::origin(std::uint32_t seed) {
    constexpr std::uint32_t stride = 397; // odd: every shift comes once before one comes again
    const std::uint32_t shift = stride * (seed - 1) % sets;
    const std::uint32_t column = shift % jitterBlock, row = shift / jitterBlock;
    return {static_cast<float>(column), static_cast<float>(row)};
}

} // namespace shadowbench::techniques
