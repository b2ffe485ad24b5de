// The scene on the GPU: one vertex and index buffer per mesh, one instance buffer per frame.
#pragma once

#include "scene/snapshot.h"

#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

namespace shadowbench::gl {

/// A GL buffer object with its bytes accounted.
class Buffer {
public:
    Buffer();
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    /// Replaces the content.
    void upload(const void* data, std::size_t bytes);

    /// Makes it `bytes` long, all zero.
    void clear(std::size_t bytes);

    /// Binds the whole of it to a shader's storage block.
    void bindStorage(unsigned binding) const;

    [[nodiscard]] unsigned id() const { return id_; }

private:
    unsigned id_ = 0;
    std::size_t bytes_ = 0;
};

/// A vertex array object.
class VertexArray {
public:
    VertexArray();
    ~VertexArray();
    VertexArray(const VertexArray&) = delete;
    VertexArray& operator=(const VertexArray&) = delete;
    void bind() const;

private:
    unsigned id_ = 0;
};

/// Vertex attributes (gl/instance.glsl): 0 position; 1–3 rows of world-from-object; 4–6 the same one frame earlier; 7
/// surface id and whether the placement moves; 8 position one frame earlier, of drawWithMotion() alone.
class SceneBuffers {
public:
    /// Uploads meshes not seen before and this frame's placements.
    void update(const Snapshot& snapshot);

    /// Draws every batch, instanced, with the program that is in use.
    void draw() const;

    /// The same for a program that reads where vertices were one frame earlier, too.
    void drawWithMotion() const;

    /// Draws the placements, counted through the snapshot's batches in order, for which `shown` is true.
    void draw(const std::vector<bool>& shown) const;

    /// Binds the instance attributes 1–7 of the current vertex array; a draw's base instance picks the placement, counted
    /// through the snapshot's batches in order.
    void bindInstances() const;

    /// A batch as compute shaders read it (gl/triangles.glsl).
    struct Batch {
        const Buffer& vertices;
        const Buffer& indices;
        int triangles, instances;
        unsigned baseInstance;
    };
    [[nodiscard]] std::vector<Batch> batches() const;
    [[nodiscard]] const Buffer& instances() const { return instances_; }

    /// True when some placement moved since the previous frame.
    [[nodiscard]] bool moving() const { return moving_; }

private:
    struct GpuMesh {
        std::shared_ptr<const Mesh> source; // keeps the key alive
        Buffer vertices, indices;
        VertexArray layout;
        int indexCount = 0;
    };
    struct Draw {
        const GpuMesh* mesh;
        const GpuMesh* previousMesh; // the same but where it deforms
        int instances;
        unsigned baseInstance;
    };

    static void draw(const Draw& draw); // with its mesh's layout bound
    GpuMesh& meshOnGpu(const std::shared_ptr<const Mesh>& mesh);

    std::unordered_map<const Mesh*, GpuMesh> meshes_;
    Buffer instances_;
    std::vector<Draw> draws_;
    bool moving_ = false;
};

} // namespace shadowbench::gl
