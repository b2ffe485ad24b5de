// What a driver compiles at once: the shaders of a draw or a dispatch, and the state that their machine code depends on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gpu {

enum class Stage { Vertex, Fragment, Compute };

/// "vertex", "fragment", "compute".
std::string_view name(Stage stage);

/// Throws BadInput for another word.
Stage stageNamed(std::string_view word);

/// A shader as the user of OpenGL or Vulkan writes it.
struct Shader {
    Stage stage;
    std::string name;                      // of its file, for messages and tables
    std::string text = {};                 // GLSL with its #version; empty: `spirv` holds it
    std::vector<std::uint32_t> spirv = {}; // a module with one entry point
};

// Enumerants are OpenGL's (GL_FLOAT, GL_RGBA16F, …).

struct Attribute {
    unsigned location = 0;
    unsigned buffer = 0; // index in State::buffers
    unsigned offset = 0; // from the first attribute of that buffer, in bytes
    unsigned type = 0;
    unsigned components = 0;
    bool integer = false; // read as an integer
    bool normalised = false;
};

struct VertexBuffer {
    unsigned stride = 0;
    unsigned divisor = 0; // 0: a value for each vertex, else for so many instances
};

struct ColourTarget {
    unsigned format = 0;
    unsigned writeMask = 15; // bits: R, G, B, A
    bool blends = false;
    unsigned source = 0, destination = 0, equation = 0; // of a target that blends
};

/// Of a dispatch as it is here.
struct State {
    unsigned topology = 0;
    std::vector<VertexBuffer> buffers = {};
    std::vector<Attribute> attributes = {};
    std::vector<ColourTarget> colours = {};
    unsigned depthFormat = 0; // 0: none
    bool depthTest = false, depthWrite = false, stencilTest = false;
    unsigned depthFunction = 0;
    unsigned culledFace = 0; // 0: none
    bool logicOperation = false;
};

struct Pipeline {
    std::vector<Shader> shaders;
    State state;

    /// A hash of all but names: pipelines with one digest have the same machine code.
    [[nodiscard]] std::string digest() const;
};

} // namespace shadowbench::gpu
