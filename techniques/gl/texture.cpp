#include "techniques/gl/texture.h"

#include "base/error.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/scene_buffers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <utility>
#include <vector>

namespace shadowbench::gl {
namespace {

struct FormatFacts {
    GLenum internal;
    std::size_t bytes; // a texel
};

FormatFacts facts(Format format) {
    switch (format) {
    case Format::R8:
        return {GL_R8, 1};
    case Format::RGBA8:
        return {GL_RGBA8, 4};
    case Format::R32F:
        return {GL_R32F, 4};
    case Format::RG16F:
        return {GL_RG16F, 4};
    case Format::RG32F:
        return {GL_RG32F, 8};
    case Format::RGBA16F:
        return {GL_RGBA16F, 8};
    case Format::RGBA32F:
        return {GL_RGBA32F, 16};
    case Format::R32UI:
        return {GL_R32UI, 4};
    case Format::Depth32F:
        return {GL_DEPTH_COMPONENT32F, 4};
    case Format::Depth32FStencil8:
        return {GL_DEPTH32F_STENCIL8, 8};
    case Format::RGBA16:
        return {GL_RGBA16, 8};
    case Format::RG32UI:
        return {GL_RG32UI, 8};
    }
    throw InternalError("unknown texture format");
}

/// Levels down to 1 × 1.
int fullChain(glm::ivec2 size) { return std::bit_width(static_cast<unsigned>(std::max(size.x, size.y))); }

bool isDepth(Format format) { return format == Format::Depth32F || format == Format::Depth32FStencil8; }

/// GL's row 0 is at the bottom, ours at the top.
template <typename T>
Image<T> readPixels(unsigned framebuffer, glm::ivec2 size, GLenum buffer, GLenum format, GLenum type) {
    Image<T> image(size.x, size.y);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    if (buffer != GL_NONE) glReadBuffer(buffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, format, type, image.data());
    for (int y = 0; y < size.y / 2; ++y) std::swap_ranges(&image(0, y), &image(0, y) + size.x, &image(0, size.y - 1 - y));
    return image;
}

/// Checks the framebuffer that is bound.
void requireComplete() {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw InternalError("a framebuffer is incomplete (status " + std::to_string(status) + ")");
}

/// On a unit that no sampler is given, the last of those that OpenGL 4.5 has at least: what programs have bound stays.
void bindToChange(GLenum target, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + 79);
    glBindTexture(target, texture);
}

GLuint makeFramebuffer(std::span<const Texture* const> attachments) {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    std::vector<GLenum> colours;
    for (const Texture* texture : attachments) {
        GLenum point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colours.size());
        if (texture->format() == Format::Depth32F) point = GL_DEPTH_ATTACHMENT;
        if (texture->format() == Format::Depth32FStencil8) point = GL_DEPTH_STENCIL_ATTACHMENT;
        if (!isDepth(texture->format())) colours.push_back(point);
        glFramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture->id(), 0);
    }
    if (colours.empty()) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    } else {
        glDrawBuffers(static_cast<GLsizei>(colours.size()), colours.data());
    }
    requireComplete();
    return id;
}

GLuint makeFramebuffer(const TextureArray& array, int layer) {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, array.id(), 0, layer);
    requireComplete();
    return id;
}

GLenum formatOf(BufferTexture::Texel texel) {
    switch (texel) {
    case BufferTexture::Texel::FourFloats:
        return GL_RGBA32F;
    case BufferTexture::Texel::FourWords:
        return GL_RGBA32UI;
    case BufferTexture::Texel::Word:
        return GL_R32UI;
    }
    throw InternalError("no such texel");
}

} // namespace

Texture::Texture(Format format, glm::ivec2 size, Filter filter, Wrap wrap, Levels levels)
    : format_(format), size_(size), levels_(levels) {
    glGenTextures(1, &id_);
    bindToChange(GL_TEXTURE_2D, id_);
    glTexStorage2D(GL_TEXTURE_2D, levels == Levels::All ? fullChain(size) : 1, facts(format).internal, size.x, size.y);
    const GLint sampling = filter == Filter::Linear ? GL_LINEAR : GL_NEAREST;
    const GLint betweenLevels = filter == Filter::Linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, levels == Levels::All ? betweenLevels : sampling);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling);
    const GLint wrapping = wrap == Wrap::BorderFar ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapping);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapping);
    const float far = isDepth(format) ? 1 : nothingInTheWay;
    const std::array<float, 4> border{far, far, far, far};
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border.data());
    Context::current().tally().allocate(bytes());
    Context::current().check("allocating a texture of " + std::to_string(size.x) + "×" + std::to_string(size.y));
}

Texture::~Texture() { release(); }

void Texture::release() {
    if (id_ == 0) return;
    Context& context = Context::current();
    context.tally().release(bytes());
    context.framebuffers().forget(id_);
    glDeleteTextures(1, &id_);
    id_ = 0;
}

Texture::Texture(Texture&& other) noexcept
    : id_(std::exchange(other.id_, 0)), format_(other.format_), size_(other.size_), levels_(other.levels_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    if (this == &other) return *this;
    release();
    id_ = std::exchange(other.id_, 0);
    format_ = other.format_;
    size_ = other.size_;
    levels_ = other.levels_;
    return *this;
}

void Texture::makeMipmaps() {
    bindToChange(GL_TEXTURE_2D, id_);
    glGenerateMipmap(GL_TEXTURE_2D);
}

void Texture::compareDepth() {
    bindToChange(GL_TEXTURE_2D, id_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

void Texture::bindImage(unsigned unit) const {
    glBindImageTexture(unit, id_, 0, GL_FALSE, 0, GL_WRITE_ONLY, facts(format_).internal);
}

void Texture::upload(const Image<std::uint8_t>& texels) {
    bindToChange(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texels.width(), texels.height(), GL_RED, GL_UNSIGNED_BYTE, texels.data());
    Context::current().check("uploading a texture");
}

std::size_t Texture::bytes() const {
    std::size_t texels = 0;
    for (int level = 0; level < (levels_ == Levels::All ? fullChain(size_) : 1); ++level)
        texels += static_cast<std::size_t>(std::max(size_.x >> level, 1)) *
                  static_cast<std::size_t>(std::max(size_.y >> level, 1));
    return facts(format_).bytes * texels;
}

TextureArray::TextureArray(Format format, glm::ivec2 size, int layers) : size_(size), layers_(layers), bytes_(0) {
    const int levels = fullChain(size);
    glGenTextures(1, &id_);
    bindToChange(GL_TEXTURE_2D_ARRAY, id_);
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, levels, facts(format).internal, size.x, size.y, layers);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    for (int level = 0; level < levels; ++level) {
        const glm::ivec2 part = glm::max(size >> level, glm::ivec2(1));
        bytes_ += facts(format).bytes * static_cast<std::size_t>(part.x * part.y) * static_cast<std::size_t>(layers);
    }
    Context::current().tally().allocate(bytes_);
    Context::current().check("allocating " + std::to_string(layers) + " layers of " + std::to_string(size.x) + "×" +
                             std::to_string(size.y));
}

TextureArray::~TextureArray() {
    Context& context = Context::current();
    context.tally().release(bytes_);
    context.framebuffers().forget(id_);
    glDeleteTextures(1, &id_);
}

void TextureArray::makeMipmaps() {
    bindToChange(GL_TEXTURE_2D_ARRAY, id_);
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

BufferTexture::BufferTexture(const Buffer& buffer, Texel texel) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id()); // a name is a buffer once it has been bound
    glGenTextures(1, &id_);
    bindToChange(GL_TEXTURE_BUFFER, id_);
    glTexBuffer(GL_TEXTURE_BUFFER, formatOf(texel), buffer.id());
}

BufferTexture::~BufferTexture() { glDeleteTextures(1, &id_); }

RenderTarget::RenderTarget(std::initializer_list<const Texture*> attachments)
    : RenderTarget(std::span<const Texture* const>(attachments.begin(), attachments.size())) {}

RenderTarget::RenderTarget(std::span<const Texture* const> attachments) {
    Attachments names;
    std::size_t count = 0;
    for (const Texture* texture : attachments) {
        size_ = texture->size();
        names.textures.at(count++) = texture->id();
    }
    id_ = Context::current().framebuffers().over(names, [&] { return makeFramebuffer(attachments); });
}

RenderTarget::RenderTarget(const TextureArray& array, int layer) : size_(array.size()) {
    id_ = Context::current().framebuffers().over({{array.id()}, layer}, [&] { return makeFramebuffer(array, layer); });
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(0, 0, size_.x, size_.y);
    ++Context::current().tally().passes;
}

void RenderTarget::clearColour(int attachment, glm::vec4 value) const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glClearBufferfv(GL_COLOR, attachment, &value.x);
}

void RenderTarget::clearColour(int attachment, unsigned value) const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    const std::array<GLuint, 4> values{value, 0, 0, 0};
    glClearBufferuiv(GL_COLOR, attachment, values.data());
}

void RenderTarget::clearDepth(float value) const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &value);
}

void RenderTarget::clearStencil() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glStencilMask(0xFF);
    constexpr GLint zero = 0;
    glClearBufferiv(GL_STENCIL, 0, &zero);
}

Image<float> RenderTarget::readFloat(int attachment) const {
    return readPixels<float>(id_, size_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment), GL_RED, GL_FLOAT);
}

Image<glm::vec4> RenderTarget::readVec4(int attachment) const {
    return readPixels<glm::vec4>(id_, size_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment), GL_RGBA, GL_FLOAT);
}

Image<unsigned> RenderTarget::readUint(int attachment) const {
    return readPixels<unsigned>(id_, size_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment), GL_RED_INTEGER,
                                GL_UNSIGNED_INT);
}

Image<float> RenderTarget::readDepth() const { return readPixels<float>(id_, size_, GL_NONE, GL_DEPTH_COMPONENT, GL_FLOAT); }

} // namespace shadowbench::gl
