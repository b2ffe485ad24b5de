#include "techniques/contract/bare/bare_drawer.h"

#include "techniques/gl/api.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t asTarget = 100; // index of textures that are drawn into; those that are read count from 0

bool isDepth(gl::Format format) { return format == gl::Format::Depth32F || format == gl::Format::Depth32FStencil8; }

bool isLinear(Read read) { return read == Read::Linear || read == Read::CompareBilinear; }
bool compares(Read read) { return read == Read::Compare || read == Read::CompareBilinear; }

std::string samplerOf(std::size_t index) { return fmt::format("source{}", index); }

/// The numbers of a texel added up, so that all that it holds is read.
std::string summed(gl::Format format, const std::string& texel) {
    switch (format) {
    case gl::Format::RG16F:
    case gl::Format::RG32F:
        return fmt::format("dot({}.rg, vec2(1.0))", texel);
    case gl::Format::RGBA8:
    case gl::Format::RGBA16F:
    case gl::Format::RGBA32F:
        return fmt::format("dot({}, vec4(1.0))", texel);
    default:
        return texel + ".r";
    }
}

/// The reads of one texture, in a loop of constant length over a square of texels.
std::string readsOf(const Taps& taps, std::size_t index) {
    const std::string sampler = samplerOf(index);
    if (taps.read == Read::Pixel) {
        const std::string texel = fmt::format("texelFetch({}, ivec2(gl_FragCoord.xy), 0)", sampler);
        return fmt::format("    sum += {};\n", summed(taps.format, texel));
    }
    int across = 1;
    while (across * across < taps.count) ++across;
    const std::string place = fmt::format("place + vec2(i % {0}, i / {0}) * texel{1}", across, index);
    const std::string value = compares(taps.read) ? fmt::format("texture({}, vec3({}, 0.5))", sampler, place)
                                                  : summed(taps.format, fmt::format("texture({}, {})", sampler, place));
    return fmt::format("    vec2 texel{0} = 1.0 / vec2(textureSize({1}, 0));\n"
                       "    for (int i = 0; i < {2}; ++i) sum += {3};\n",
                       index, sampler, taps.count, value);
}

std::string fragmentShader(const std::vector<Taps>& taps, std::size_t targets) {
    std::string declarations = "uniform vec2 inverseSize;\n", body = "    float sum = 0.0;\n", results;
    for (std::size_t i = 0; i < targets; ++i) {
        declarations += fmt::format("layout(location = {0}) out vec4 result{0};\n", i);
        results += fmt::format("    result{} = vec4(sum);\n", i);
    }
    if (std::ranges::any_of(taps, [](const Taps& t) { return t.read != Read::Pixel; }))
        body += "    vec2 place = gl_FragCoord.xy * inverseSize;\n";
    for (std::size_t i = 0; i < taps.size(); ++i) {
        const char* kind = compares(taps[i].read) ? "sampler2DShadow" : "sampler2D";
        declarations += fmt::format("uniform {} {};\n", kind, samplerOf(i));
        body += readsOf(taps[i], i);
    }
    return declarations + "void main() {\n" + body + results + "}\n";
}

} // namespace

const gl::Texture& BareDrawer::texture(gl::Format format, glm::ivec2 size, Read read, std::size_t index) {
    const TextureKey key(format, size.x, size.y, read, index);
    const auto known = textures_.find(key);
    if (known != textures_.end()) return known->second;
    gl::Texture made(format, size, isLinear(read) ? gl::Filter::Linear : gl::Filter::Nearest);
    if (compares(read)) made.compareDepth();
    const gl::Texture& texture = textures_.emplace(key, std::move(made)).first->second;
    const gl::RenderTarget content{&texture}; // numbers, so that no sum is slowed by what is none
    if (isDepth(format))
        content.clearDepth(0.5F);
    else if (format == gl::Format::R32UI)
        content.clearColour(0, 1U);
    else
        content.clearColour(0, glm::vec4(0.5F));
    return texture;
}

gl::RenderTarget BareDrawer::target(const BarePass& pass) {
    std::vector<const gl::Texture*> attachments;
    for (std::size_t i = 0; i < pass.targets.size(); ++i)
        attachments.push_back(&texture(pass.targets[i], pass.size, Read::Pixel, asTarget + i));
    return gl::RenderTarget(attachments);
}

gl::Program& BareDrawer::casterProgram(bool colour, bool plane) {
    const std::string key = fmt::format("casters {} {}", colour, plane);
    const auto known = programs_.find(key);
    if (known != programs_.end()) return known->second;
    const gl::Defines defines = plane ? gl::Defines{{"PLANE", "1"}} : gl::Defines{};
    const char* fragments = colour ? "contract/bare/casters.frag" : "gl/depth_only.frag";
    return programs_.emplace(key, gl::Program("contract/bare/casters.vert", fragments, defines)).first->second;
}

void BareDrawer::drawCasters(const Frame& frame, const BarePass& pass) {
    const bool depth = std::ranges::any_of(pass.targets, isDepth);
    const bool colour = !std::ranges::all_of(pass.targets, isDepth);
    const auto toggle = [](GLenum state, bool on) { on ? glEnable(state) : glDisable(state); };
    toggle(GL_DEPTH_TEST, depth);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP); // of casters before the near plane, as techniques draw them
    for (const Casters& casters : pass.casters) {
        const glm::ivec2 size = casters.size == glm::ivec2(0) ? pass.size : casters.size;
        glViewport(casters.at.x, casters.at.y, size.x, size.y);
        gl::Program& program = casterProgram(colour, casters.plane.has_value());
        program.set("clipFromWorld", glm::mat4(casters.clipFromWorld));
        if (casters.plane) program.set("plane", glm::vec4(*casters.plane));
        toggle(GL_CLIP_DISTANCE0, casters.plane.has_value());
        program.use();
        if (casters.shown.empty())
            frame.scene.draw();
        else
            frame.scene.draw(casters.shown);
    }
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_DEPTH_CLAMP);
}

void BareDrawer::drawScreen(const BarePass& pass) {
    const std::string source = fragmentShader(pass.taps, pass.targets.size());
    auto known = programs_.find(source);
    if (known == programs_.end()) known = programs_.emplace(source, gl::Program::screenFromText("bare pass", source)).first;
    gl::Program& program = known->second;
    if (program.uses("inverseSize")) program.set("inverseSize", 1.0F / glm::vec2(pass.size));
    for (std::size_t i = 0; i < pass.taps.size(); ++i)
        if (pass.taps[i].count > 0)
            program.set(samplerOf(i), texture(pass.taps[i].format, pass.taps[i].size, pass.taps[i].read, i));
    program.drawScreen();
}

void BareDrawer::draw(const Frame& frame, const std::vector<BarePass>& passes) {
    for (const BarePass& bare : passes) {
        const auto pass = frame.pass(bare.pass);
        if (bare.own) {
            bare.own();
            continue;
        }
        const gl::RenderTarget into = target(bare);
        if (bare.taps.empty()) { // of a pass over all texels nothing shows through
            for (std::size_t i = 0; i < bare.targets.size(); ++i)
                isDepth(bare.targets[i]) ? into.clearDepth(1) : into.clearColour(static_cast<int>(i), glm::vec4(1));
        }
        into.bind();
        if (!bare.casters.empty()) drawCasters(frame, bare);
        if (!bare.taps.empty()) drawScreen(bare);
    }
}

} // namespace shadowbench::techniques
