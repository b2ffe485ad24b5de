// A linked GLSL program. Sources are the files under techniques/, embedded by the build; `#include
// "shared/maps/light_space.glsl"` is resolved when loaded, and a compile error names the file and line it comes from.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace shadowbench::gl {

class Texture;
class TextureArray;
class Buffer;
class BufferTexture;

/// Preprocessor definitions put before the source.
using Defines = std::vector<std::pair<std::string, std::string>>;

/// A shader's source with its includes in place. `origin[i]` names file and line of line i + 1 of `text`, `files` the files
/// that it was put together from.
struct ShaderSource {
    std::string text;
    std::vector<std::string> origin;
    std::set<std::string> files = {};
};

/// Throws InternalError naming a file that is not there, and what includes it.
ShaderSource loadShader(const std::string& file, const Defines& defines);

/// The same of a source that is no file; `name` stands for it in messages.
ShaderSource shaderFromText(const std::string& name, const std::string& text, const Defines& defines);

/// Shaders by the names that `#include` has for them.
using ShaderFiles = std::map<std::string, std::string>;

/// Shaders that are not embedded, and the folder that stands before their names in messages. What they include is theirs, or
/// an embedded file.
struct ShaderFolder {
    std::string path;
    const ShaderFiles& files;
};

/// Whether the program carries a shader of this name.
bool isEmbedded(const std::string& file);

/// The embedded shaders of `folder` ("filtered/pcf"), by their names in it.
ShaderFiles embeddedShaders(const std::string& folder);

/// What messages call a folder's file, or an embedded one.
std::string placeOf(const ShaderFolder& folder, const std::string& file);

/// The same of one of a folder's files, or an embedded one.
ShaderSource loadShader(const ShaderFolder& folder, const std::string& file, const Defines& defines);

class Program {
public:
    Program(const std::string& vertexFile, const std::string& fragmentFile, const Defines& defines = {});

    /// A full-screen pass of one fragment shader.
    static Program screen(const std::string& fragmentFile, const Defines& defines = {});

    /// The same of a source that is no file: for shaders that are put together where they are used.
    static Program screenFromText(const std::string& name, const std::string& fragmentText, const Defines& defines = {});

    /// An embedded vertex shader, and a fragment shader of a folder or an embedded one.
    static Program ofFolder(const std::string& vertexFile, const ShaderFolder& folder, const std::string& fragmentFile,
                            const Defines& defines);

    /// A compute shader.
    static Program compute(const std::string& file, const Defines& defines = {});

    /// The same of a folder, or an embedded one.
    static Program computeOfFolder(const ShaderFolder& folder, const std::string& file, const Defines& defines);

    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&&) = delete;

    /// Uniforms by name. A name the linked program does not use is an InternalError: a misspelt uniform must not pass in
    /// silence.
    Program& set(const std::string& uniform, int value);
    Program& set(const std::string& uniform, float value);
    Program& set(const std::string& uniform, glm::vec2 value);
    Program& set(const std::string& uniform, glm::vec3 value);
    Program& set(const std::string& uniform, glm::vec4 value);
    Program& set(const std::string& uniform, const glm::mat4& value);
    Program& set(const std::string& uniform, std::span<const glm::vec2> values);
    Program& set(const std::string& uniform, std::span<const glm::vec4> values);
    Program& set(const std::string& uniform, std::span<const glm::mat4> values);

    /// Binds the texture to the sampler of that name.
    Program& set(const std::string& sampler, const Texture& texture);
    Program& set(const std::string& sampler, const TextureArray& array);
    Program& set(const std::string& sampler, const BufferTexture& buffer);

    /// Lets the image of that name be stored into the texture's largest level.
    Program& setImage(const std::string& image, const Texture& texture);

    [[nodiscard]] bool uses(const std::string& uniform) const { return uniforms_.contains(uniform); }

    /// The uniforms in use with their types as GLSL has them, of an array "vec2[]"; another type than those of `set` is "".
    [[nodiscard]] std::map<std::string, std::string> uniformTypes() const;

    /// How many outputs of a fragment shader are written.
    [[nodiscard]] int outputs() const;

    /// The elements of an array that are in use; 1 of another uniform.
    [[nodiscard]] int elements(const std::string& name) const { return uniform(name).elements; }
    void use() const;

    /// Runs the full-screen pass into the framebuffer that is bound for drawing.
    void drawScreen() const;

    /// The same for a shader that writes gl_FragDepth: every pixel's depth is replaced.
    void drawScreenDepth() const;

    /// Runs at least `invocations` invocations of a compute shader, numbered by invocation() of gl/invocation.glsl; what it
    /// wrote is visible to everything after. Counts as a pass.
    void dispatch(std::size_t invocations) const;

    /// The same of as many work groups along each axis, 65,535 at most.
    void dispatchGroups(glm::uvec3 groups) const;

    /// The same of the groups that shaders have written to `buffer`: three words from word `first` on.
    void dispatchGroups(const Buffer& buffer, std::size_t first) const;

    /// Invocations of a work group of a compute shader.
    [[nodiscard]] glm::uvec3 groupSize() const;

private:
    struct Stage {
        unsigned kind; // GL's
        std::string name;
        ShaderSource source;
    };
    explicit Program(const std::vector<Stage>& stages);
    void findUniforms();

    struct Uniform {
        int location;
        int unit;      // texture unit of a sampler, image unit of an image, else −1
        unsigned type; // GL's
        bool array;
        int elements;
    };
    void activateUnit(const std::string& sampler) const;
    void drawTriangle() const;
    [[nodiscard]] const Uniform& uniform(const std::string& name) const;

    unsigned id_ = 0;
    std::string title_;
    std::unordered_map<std::string, Uniform> uniforms_;
};

} // namespace shadowbench::gl
