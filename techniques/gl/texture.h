// Two-dimensional textures and the framebuffers that draw into them. Bytes are accounted in Context::tally().
#pragma once

#include "base/image.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <span>

namespace shadowbench::gl {

class Buffer;

enum class Format { R8, RGBA8, R32F, RG16F, RG32F, RGBA16F, RGBA32F, R32UI, Depth32F, Depth32FStencil8, RGBA16, RG32UI };

/// How a sampler reads between texels and outside [0, 1]².
enum class Filter { Nearest, Linear };
enum class Levels { One, All };             // All: mipmaps, of which a sampler reads two
enum class Wrap { ClampToEdge, BorderFar }; // BorderFar: outside reads as the farthest depth

/// The farthest depth of a map of linear depths in metres; a depth texture's is 1.
inline constexpr float nothingInTheWay = 1e30F;

class Texture {
public:
    Texture(Format format, glm::ivec2 size, Filter filter = Filter::Nearest, Wrap wrap = Wrap::ClampToEdge,
            Levels levels = Levels::One);
    ~Texture();
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;

    /// Makes sampler2DShadow lookups compare (reference ≤ texel); with Filter::Linear the four comparisons are interpolated.
    void compareDepth();

    /// Every level from the one before it, by 2 × 2 means (`Levels::All`).
    void makeMipmaps();

    /// Lets image unit `unit` be stored into the largest level.
    void bindImage(unsigned unit) const;

    /// Replaces the texels of an R8 texture of the image's size; row 0 of the image is at texture coordinate 0.
    void upload(const Image<std::uint8_t>& texels);

    [[nodiscard]] unsigned id() const { return id_; }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] Format format() const { return format_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    void release();
    unsigned id_ = 0;
    Format format_;
    glm::ivec2 size_;
    Levels levels_;
};

/// Layers of one colour format and size, each with its mipmaps; read trilinearly and clamped to the edge.
class TextureArray {
public:
    TextureArray(Format format, glm::ivec2 size, int layers);
    ~TextureArray();
    TextureArray(const TextureArray&) = delete;
    TextureArray& operator=(const TextureArray&) = delete;

    /// Every level from the one before it, by 2 × 2 means.
    void makeMipmaps();

    [[nodiscard]] unsigned id() const { return id_; }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] int layers() const { return layers_; }

private:
    unsigned id_ = 0;
    glm::ivec2 size_;
    int layers_;
    std::size_t bytes_; // all levels
};

/// A buffer that shaders read through a samplerBuffer or usamplerBuffer: a software rasteriser reads a storage block one
/// invocation after the other, and a texture for several at once. The buffer must outlive it.
class BufferTexture {
public:
    enum class Texel { FourFloats, FourWords, Word };

    BufferTexture(const Buffer& buffer, Texel texel);
    ~BufferTexture();
    BufferTexture(const BufferTexture&) = delete;
    BufferTexture& operator=(const BufferTexture&) = delete;

    [[nodiscard]] unsigned id() const { return id_; }

private:
    unsigned id_ = 0;
};

/// Textures to draw into: colour attachments in order, and at most one depth(-stencil) texture. They must outlive it. Cheap
/// to make: the framebuffer itself is kept as long as its textures live (gl/framebuffers.h).
class RenderTarget {
public:
    explicit RenderTarget(std::initializer_list<const Texture*> attachments);
    explicit RenderTarget(std::span<const Texture* const> attachments);

    /// Draws into the largest level of one layer.
    RenderTarget(const TextureArray& array, int layer);

    /// Binds for drawing and sets the viewport to the whole of it; counts as a pass.
    void bind() const;

    /// Binds and clears colour attachment `attachment` (float or unsigned formats).
    void clearColour(int attachment, glm::vec4 value) const;
    void clearColour(int attachment, unsigned value) const;
    void clearDepth(float value) const;
    void clearStencil() const;

    [[nodiscard]] glm::ivec2 size() const { return size_; }

    // Read back, row 0 at the top. Blocks until the GPU is done.
    [[nodiscard]] Image<float> readFloat(int attachment) const;
    [[nodiscard]] Image<glm::vec4> readVec4(int attachment) const;
    [[nodiscard]] Image<unsigned> readUint(int attachment) const;
    [[nodiscard]] Image<float> readDepth() const;

private:
    unsigned id_ = 0;
    glm::ivec2 size_{0, 0};
};

} // namespace shadowbench::gl
