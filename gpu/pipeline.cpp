#include "gpu/pipeline.h"

#include "base/hash.h"
#include "base/words.h"

#include <fmt/format.h>

namespace shadowbench::gpu {
namespace {

constexpr Words<Stage, 3> stages{"stage",
                                 {{{Stage::Vertex, "vertex"}, {Stage::Fragment, "fragment"}, {Stage::Compute, "compute"}}}};

std::string text(const State& state) {
    std::string all =
        fmt::format("{} depth {} {} {} {} stencil {} cull {} logic {}\n", state.topology, state.depthFormat, state.depthTest,
                    state.depthWrite, state.depthFunction, state.stencilTest, state.culledFace, state.logicOperation);
    for (const VertexBuffer& buffer : state.buffers) all += fmt::format("buffer {} {}\n", buffer.stride, buffer.divisor);
    for (const Attribute& a : state.attributes)
        all += fmt::format("attribute {} {} {} {} {} {} {}\n", a.location, a.buffer, a.offset, a.type, a.components,
                           a.integer, a.normalised);
    for (const ColourTarget& c : state.colours)
        all +=
            fmt::format("colour {} {} {} {} {} {}\n", c.format, c.writeMask, c.blends, c.source, c.destination, c.equation);
    return all;
}

} // namespace

std::string_view name(Stage stage) { return stages.of(stage); }
Stage stageNamed(std::string_view word) { return stages.named(word); }

std::string Pipeline::digest() const {
    Hasher128 hasher;
    const auto add = [&](std::string_view bytes) {
        const std::uint64_t size = bytes.size(); // so that no two lists of texts are one row of bytes
        hasher.add(&size, sizeof size);
        hasher.add(bytes.data(), bytes.size());
    };
    for (const Shader& shader : shaders) {
        add(gpu::name(shader.stage));
        add(shader.text);
        add({reinterpret_cast<const char*>(shader.spirv.data()), 4 * shader.spirv.size()});
    }
    add(text(state));
    return hasher.digest().text();
}

} // namespace shadowbench::gpu
