#include "gpu/state.h"

#include "base/error.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>

namespace shadowbench::gpu {
namespace {

unsigned number(GLenum what) {
    GLint found = 0;
    glGetIntegerv(what, &found);
    return static_cast<unsigned>(found);
}

Stage stageOf(GLuint shader) {
    GLint kind = 0;
    glGetShaderiv(shader, GL_SHADER_TYPE, &kind);
    switch (kind) {
    case GL_VERTEX_SHADER:
        return Stage::Vertex;
    case GL_FRAGMENT_SHADER:
        return Stage::Fragment;
    case GL_COMPUTE_SHADER:
        return Stage::Compute;
    default:
        throw InternalError("a frame draws with a shader of stage " + std::to_string(kind) + ", which is not observed");
    }
}

Shader shaderOf(GLuint id) {
    std::array<char, 512> label{};
    glGetObjectLabel(GL_SHADER, id, label.size(), nullptr, label.data());
    GLint length = 0;
    glGetShaderiv(id, GL_SHADER_SOURCE_LENGTH, &length); // with the zero at its end
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderSource(id, length, nullptr, text.data());
    text.pop_back();
    return {stageOf(id), label.data(), text};
}

struct AttributeOfContext {
    Attribute attribute; // `offset` within the whole buffer
    VertexBuffer buffer;
    unsigned name; // OpenGL's of the buffer
};

unsigned number(GLuint location, GLenum what) {
    GLint found = 0;
    glGetVertexAttribiv(location, what, &found);
    return static_cast<unsigned>(found);
}

std::vector<AttributeOfContext> enabledAttributes() {
    std::vector<AttributeOfContext> found;
    for (GLuint location = 0; location < 16; ++location) { // the least that OpenGL 4.5 has
        if (number(location, GL_VERTEX_ATTRIB_ARRAY_ENABLED) == 0) continue;
        void* offset = nullptr;
        glGetVertexAttribPointerv(location, GL_VERTEX_ATTRIB_ARRAY_POINTER, &offset);
        found.push_back({{.location = location,
                          .offset = static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(offset)),
                          .type = number(location, GL_VERTEX_ATTRIB_ARRAY_TYPE),
                          .components = number(location, GL_VERTEX_ATTRIB_ARRAY_SIZE),
                          .integer = number(location, GL_VERTEX_ATTRIB_ARRAY_INTEGER) != 0,
                          .normalised = number(location, GL_VERTEX_ATTRIB_ARRAY_NORMALIZED) != 0},
                         {number(location, GL_VERTEX_ATTRIB_ARRAY_STRIDE), number(location, GL_VERTEX_ATTRIB_ARRAY_DIVISOR)},
                         number(location, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING)});
    }
    return found;
}

/// Buffers in the order of the attributes, so that OpenGL's names for them and where they begin do not matter.
void addAttributes(State& state) {
    std::map<std::tuple<unsigned, unsigned, unsigned>, unsigned> buffers;
    std::vector<unsigned> begins;
    std::vector<AttributeOfContext> attributes = enabledAttributes();
    for (AttributeOfContext& each : attributes) {
        const auto [entry, isNew] = buffers.try_emplace({each.name, each.buffer.stride, each.buffer.divisor},
                                                        static_cast<unsigned>(state.buffers.size()));
        each.attribute.buffer = entry->second;
        if (isNew) {
            state.buffers.push_back(each.buffer);
            begins.push_back(each.attribute.offset);
        }
        begins[entry->second] = std::min(begins[entry->second], each.attribute.offset);
    }
    for (AttributeOfContext& each : attributes) {
        each.attribute.offset -= begins[each.attribute.buffer];
        state.attributes.push_back(each.attribute);
    }
}

/// What the framebuffer that is drawn into has at `attachment`.
Target attached(GLenum attachment) {
    GLint texture = 0;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &texture);
    if (texture != GL_TEXTURE) return {};
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &texture);
    return textureTarget(static_cast<GLuint>(texture));
}

unsigned formatOf(GLenum attachment) { return attached(attachment).format; }

void addColours(State& state) {
    std::array<GLboolean, 4> written{};
    glGetBooleanv(GL_COLOR_WRITEMASK, written.data());
    unsigned mask = 0;
    for (unsigned channel = 0; channel < 4; ++channel) mask |= written[channel] != GL_FALSE ? 1U << channel : 0U;
    const bool blends = glIsEnabled(GL_BLEND) == GL_TRUE;
    for (GLenum i = 0; i < 8; ++i) {
        const GLenum buffer = number(GL_DRAW_BUFFER0 + i);
        const unsigned format = buffer == GL_NONE ? 0 : formatOf(buffer);
        if (format == 0) break;
        ColourTarget target{.format = format, .writeMask = mask, .blends = blends};
        if (blends) {
            target.source = number(GL_BLEND_SRC_RGB);
            target.destination = number(GL_BLEND_DST_RGB);
            target.equation = number(GL_BLEND_EQUATION_RGB);
        }
        state.colours.push_back(target);
    }
}

} // namespace

Target textureTarget(unsigned texture) {
    const auto level = [texture](GLenum what) {
        GLint found = 0;
        glGetTextureLevelParameteriv(texture, 0, what, &found);
        return found;
    };
    return {static_cast<unsigned>(level(GL_TEXTURE_INTERNAL_FORMAT)), level(GL_TEXTURE_WIDTH), level(GL_TEXTURE_HEIGHT)};
}

Target clearedBy(unsigned buffer, int drawBuffer) {
    if (buffer == GL_DEPTH) return attached(GL_DEPTH_ATTACHMENT);
    if (buffer == GL_STENCIL) return attached(GL_STENCIL_ATTACHMENT);
    const GLenum colour = number(GL_DRAW_BUFFER0 + static_cast<GLenum>(drawBuffer));
    return colour == GL_NONE ? Target() : attached(colour);
}

std::pair<int, int> viewport() {
    std::array<GLint, 4> found{};
    glGetIntegerv(GL_VIEWPORT, found.data());
    return {found[2], found[3]};
}

std::vector<Shader> currentShaders() {
    std::array<GLuint, 8> ids{};
    GLsizei count = 0;
    glGetAttachedShaders(number(GL_CURRENT_PROGRAM), ids.size(), &count, ids.data());
    std::vector<Shader> shaders;
    for (GLsizei i = 0; i < count; ++i) shaders.push_back(shaderOf(ids[static_cast<std::size_t>(i)]));
    std::ranges::sort(shaders, {}, &Shader::stage);
    return shaders;
}

State drawState(unsigned topology) {
    State state{.topology = topology};
    addAttributes(state);
    addColours(state);
    state.depthFormat = formatOf(GL_DEPTH_ATTACHMENT);
    state.depthTest = glIsEnabled(GL_DEPTH_TEST) == GL_TRUE;
    state.depthWrite = number(GL_DEPTH_WRITEMASK) != 0;
    state.depthFunction = number(GL_DEPTH_FUNC);
    state.stencilTest = glIsEnabled(GL_STENCIL_TEST) == GL_TRUE;
    if (glIsEnabled(GL_CULL_FACE) == GL_TRUE) state.culledFace = number(GL_CULL_FACE_MODE);
    state.logicOperation = glIsEnabled(GL_COLOR_LOGIC_OP) == GL_TRUE;
    return state;
}

} // namespace shadowbench::gpu
