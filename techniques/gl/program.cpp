#include "techniques/gl/program.h"

#include "base/error.h"
#include "base/pattern.h"
#include "base/trace.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"

#include <array>
#include <cctype>
#include <glm/gtc/type_ptr.hpp>
#include <sstream>

namespace shadowbench::gl {
namespace {

/// Mesa writes "0:12(3): error: …": puts the file and line that line 12 came from in its place.
std::string withOrigins(const std::string& log, const ShaderSource& source) {
    std::istringstream lines(log);
    std::string line, result;
    while (std::getline(lines, line)) {
        const std::vector<std::string> match = firstMatch(line, "^0:([0-9]+)\\([0-9]+\\)(.*)");
        if (!match.empty()) {
            const std::size_t number = std::stoul(match[1]);
            if (number >= 1 && number <= source.origin.size()) line = source.origin[number - 1] + match[2];
        }
        result += (result.empty() ? "" : "\n") + line;
    }
    return result;
}

GLuint compile(GLenum stage, const std::string& name, const ShaderSource& source) {
    Context::current().shaderFiles().insert(source.files.begin(), source.files.end());
    const GLuint shader = glCreateShader(stage);
    glObjectLabel(GL_SHADER, shader, static_cast<GLsizei>(name.size()), name.data()); // what debuggers and gpu/ call it
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good != 0) return shader;
    std::string log(16384, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    Context::current().discardErrors();
    throw InternalError("compiling shader " + name + " failed:\n" + withOrigins(log, source));
}

GLuint link(const std::vector<GLuint>& shaders, const std::string& title) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader : shaders) glAttachShader(program, shader);
    glLinkProgram(program);
    for (const GLuint shader : shaders) glDeleteShader(shader);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good != 0) return program;
    std::string log(16384, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteProgram(program);
    Context::current().discardErrors();
    throw InternalError("linking " + title + " failed: " + log);
}

bool isSampler(GLenum type) {
    switch (type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_BUFFER:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_BUFFER:
        return true;
    default:
        return false;
    }
}

bool isImage(GLenum type) { return type == GL_IMAGE_2D || type == GL_UNSIGNED_INT_IMAGE_2D; }

} // namespace

Program::Program(const std::string& vertexFile, const std::string& fragmentFile, const Defines& defines)
    : Program({{GL_VERTEX_SHADER, vertexFile, loadShader(vertexFile, defines)},
               {GL_FRAGMENT_SHADER, fragmentFile, loadShader(fragmentFile, defines)}}) {}

Program::Program(const std::vector<Stage>& stages) {
    const Span span("setup", stages.back().name);
    std::vector<GLuint> shaders;
    try {
        for (const Stage& stage : stages) {
            shaders.push_back(compile(stage.kind, stage.name, stage.source));
            title_ += (title_.empty() ? "" : " + ") + stage.name;
        }
    } catch (...) {
        for (const GLuint shader : shaders) glDeleteShader(shader);
        throw;
    }
    id_ = link(shaders, title_);
    findUniforms();
}

void Program::findUniforms() {
    GLint count = 0;
    glGetProgramiv(id_, GL_ACTIVE_UNIFORMS, &count);
    int samplers = 0, images = 0;
    for (GLint i = 0; i < count; ++i) {
        char buffer[256];
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(id_, static_cast<GLuint>(i), sizeof buffer, nullptr, &size, &type, buffer);
        std::string name(buffer);
        const bool array = name.ends_with("[0]");
        if (array) name.resize(name.size() - 3);
        const int unit = isSampler(type) ? samplers++ : isImage(type) ? images++ : -1;
        uniforms_[name] = {glGetUniformLocation(id_, buffer), unit, type, array, size};
    }
}

std::map<std::string, std::string> Program::uniformTypes() const {
    static const std::map<GLenum, std::string> words{{GL_INT, "int"},
                                                     {GL_FLOAT, "float"},
                                                     {GL_FLOAT_VEC2, "vec2"},
                                                     {GL_FLOAT_VEC3, "vec3"},
                                                     {GL_FLOAT_VEC4, "vec4"},
                                                     {GL_FLOAT_MAT4, "mat4"},
                                                     {GL_SAMPLER_2D, "sampler2D"},
                                                     {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
                                                     {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D"},
                                                     {GL_IMAGE_2D, "image2D"},
                                                     {GL_UNSIGNED_INT_IMAGE_2D, "uimage2D"}};
    std::map<std::string, std::string> types;
    for (const auto& [name, uniform] : uniforms_) {
        const auto word = words.find(uniform.type);
        types[name] = word == words.end() ? "" : word->second + (uniform.array ? "[]" : "");
    }
    return types;
}

int Program::outputs() const {
    GLint count = 0;
    glGetProgramInterfaceiv(id_, GL_PROGRAM_OUTPUT, GL_ACTIVE_RESOURCES, &count);
    return count;
}

Program Program::screen(const std::string& fragmentFile, const Defines& defines) {
    return {"gl/screen.vert", fragmentFile, defines};
}

Program Program::screenFromText(const std::string& name, const std::string& fragmentText, const Defines& defines) {
    return Program({{GL_VERTEX_SHADER, "gl/screen.vert", loadShader("gl/screen.vert", {})},
                    {GL_FRAGMENT_SHADER, name, shaderFromText(name, fragmentText, defines)}});
}

Program Program::ofFolder(const std::string& vertexFile, const ShaderFolder& folder, const std::string& fragmentFile,
                          const Defines& defines) {
    return Program({{GL_VERTEX_SHADER, vertexFile, loadShader(vertexFile, {})},
                    {GL_FRAGMENT_SHADER, placeOf(folder, fragmentFile), loadShader(folder, fragmentFile, defines)}});
}

Program Program::compute(const std::string& file, const Defines& defines) {
    return Program({{GL_COMPUTE_SHADER, file, loadShader(file, defines)}});
}

Program Program::computeOfFolder(const ShaderFolder& folder, const std::string& file, const Defines& defines) {
    return Program({{GL_COMPUTE_SHADER, placeOf(folder, file), loadShader(folder, file, defines)}});
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)), title_(std::move(other.title_)), uniforms_(std::move(other.uniforms_)) {}

const Program::Uniform& Program::uniform(const std::string& name) const {
    const auto found = uniforms_.find(name);
    if (found == uniforms_.end()) throw InternalError(title_ + " has no uniform " + name + " in use");
    return found->second;
}

Program& Program::set(const std::string& name, int value) {
    glProgramUniform1i(id_, uniform(name).location, value);
    return *this;
}

Program& Program::set(const std::string& name, float value) {
    glProgramUniform1f(id_, uniform(name).location, value);
    return *this;
}

Program& Program::set(const std::string& name, glm::vec2 value) {
    glProgramUniform2f(id_, uniform(name).location, value.x, value.y);
    return *this;
}

Program& Program::set(const std::string& name, glm::vec3 value) {
    glProgramUniform3f(id_, uniform(name).location, value.x, value.y, value.z);
    return *this;
}

Program& Program::set(const std::string& name, glm::vec4 value) {
    glProgramUniform4f(id_, uniform(name).location, value.x, value.y, value.z, value.w);
    return *this;
}

Program& Program::set(const std::string& name, const glm::mat4& value) {
    glProgramUniformMatrix4fv(id_, uniform(name).location, 1, GL_FALSE, glm::value_ptr(value));
    return *this;
}

Program& Program::set(const std::string& name, std::span<const glm::vec2> values) {
    glProgramUniform2fv(id_, uniform(name).location, static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
    return *this;
}

Program& Program::set(const std::string& name, std::span<const glm::vec4> values) {
    glProgramUniform4fv(id_, uniform(name).location, static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
    return *this;
}

Program& Program::set(const std::string& name, std::span<const glm::mat4> values) {
    glProgramUniformMatrix4fv(id_, uniform(name).location, static_cast<GLsizei>(values.size()), GL_FALSE,
                              glm::value_ptr(values.front()));
    return *this;
}

Program& Program::set(const std::string& sampler, const Texture& texture) {
    activateUnit(sampler);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    return *this;
}

Program& Program::set(const std::string& sampler, const TextureArray& array) {
    activateUnit(sampler);
    glBindTexture(GL_TEXTURE_2D_ARRAY, array.id());
    return *this;
}

Program& Program::set(const std::string& sampler, const BufferTexture& buffer) {
    activateUnit(sampler);
    glBindTexture(GL_TEXTURE_BUFFER, buffer.id());
    return *this;
}

Program& Program::setImage(const std::string& image, const Texture& texture) {
    const Uniform& found = uniform(image);
    if (!isImage(found.type)) throw InternalError(title_ + ": " + image + " is no image");
    glProgramUniform1i(id_, found.location, found.unit);
    texture.bindImage(static_cast<unsigned>(found.unit));
    return *this;
}

void Program::activateUnit(const std::string& sampler) const {
    const Uniform& found = uniform(sampler);
    if (!isSampler(found.type))
        throw InternalError(title_ + ": " + sampler + " is no sampler of a 2D texture, an array of them or a buffer");
    glProgramUniform1i(id_, found.location, found.unit);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(found.unit));
}

void Program::use() const { glUseProgram(id_); }

void Program::drawScreen() const {
    glDisable(GL_DEPTH_TEST);
    drawTriangle();
}

void Program::drawScreenDepth() const {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    drawTriangle();
    glDepthFunc(GL_LESS);
}

void Program::dispatch(std::size_t invocations) const {
    constexpr std::size_t group = 64, widest = 65535; // gl/invocation.glsl; the least that GL promises for an axis
    const std::size_t groups = (invocations + group - 1) / group;
    if (groups == 0) return;
    const std::size_t rows = (groups + widest - 1) / widest;
    dispatchGroups({(groups + rows - 1) / rows, rows, 1});
}

void Program::dispatchGroups(glm::uvec3 groups) const {
    use();
    glDispatchCompute(groups.x, groups.y, groups.z);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    ++Context::current().tally().passes;
}

void Program::dispatchGroups(const Buffer& buffer, std::size_t first) const {
    use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer.id());
    glDispatchComputeIndirect(static_cast<GLintptr>(first * sizeof(GLuint)));
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    ++Context::current().tally().passes;
}

glm::uvec3 Program::groupSize() const {
    std::array<GLint, 3> size{};
    glGetProgramiv(id_, GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    return {size[0], size[1], size[2]};
}

void Program::drawTriangle() const {
    use();
    glDisable(GL_CULL_FACE);
    Context& context = Context::current();
    glBindVertexArray(context.noAttributes());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++context.tally().draws;
}

} // namespace shadowbench::gl
