// Draws bare passes (techniques/contract/bare.h).
#pragma once

#include "techniques/contract/bare.h"
#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::techniques {

/// Keeps its programs and textures for all the passes that it draws: techniques share most of them.
class BareDrawer {
public:
    /// As passes of the frame, with their names.
    void draw(const Frame& frame, const std::vector<BarePass>& passes);

private:
    /// The first three say what a texture is, the last which of several equal ones.
    using TextureKey = std::tuple<gl::Format, int, int, Read, std::size_t>;

    const gl::Texture& texture(gl::Format format, glm::ivec2 size, Read read, std::size_t index);
    gl::RenderTarget target(const BarePass& pass);
    void drawCasters(const Frame& frame, const BarePass& pass);
    void drawScreen(const BarePass& pass);
    gl::Program& casterProgram(bool colour, bool plane);

    std::map<TextureKey, gl::Texture> textures_;
    std::map<std::string, gl::Program> programs_; // by source
};

} // namespace shadowbench::techniques
