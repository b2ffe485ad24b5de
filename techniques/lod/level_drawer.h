// Draws instances, each at a level of its chain: one instanced draw call a mesh.
#pragma once

#include "techniques/contract/lod_technique.h"
#include "techniques/gl/scene_buffers.h"

#include <span>
#include <unordered_map>

namespace shadowbench::techniques {

/// One instance drawn at one level.
struct LevelDraw {
    const LodInstance* instance;
    int level;
    float visibility = 1; // opacity, or the threshold τ of eq. 5.1
    std::uint32_t id = 0; // what the shader reads: 0 for what is not in transition
};

/// The level that discrete switching shows of an instance.
LevelDraw switched(const LodInstance& instance);

class LevelDrawer {
public:
    /// Uploads every mesh once.
    explicit LevelDrawer(std::span<const LodChain> chains);

    /// Draws with the program in use, whose vertex shader is lod/instance.vert; draws of one mesh keep their order, meshes
    /// are drawn in the order of their first draw.
    void draw(std::span<const LodChain> chains, std::span<const LevelDraw> draws);

private:
    struct GpuMesh {
        gl::Buffer vertices, indices;
        gl::VertexArray layout;
        int indexCount = 0;
    };

    void upload(const Mesh& mesh);

    gl::Buffer instances_;
    std::unordered_map<const Mesh*, GpuMesh> meshes_;
};

} // namespace shadowbench::techniques
