#include "techniques/gl/scene_buffers.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <array>
#include <glm/mat3x4.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::gl {
namespace {

/// What a vertex shader reads of one placement.
struct InstanceData {
    glm::mat3x4 world; // three rows of the affine matrix
    glm::mat3x4 previous;
    std::array<GLuint, 2> idAndMoving;
};

glm::mat3x4 rows(const glm::dmat4& affine) { return glm::mat3x4(glm::transpose(affine)); }

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

} // namespace

Buffer::Buffer() { glGenBuffers(1, &id_); }

Buffer::~Buffer() {
    Context::current().tally().release(bytes_);
    glDeleteBuffers(1, &id_);
}

void Buffer::upload(const void* data, std::size_t bytes) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, id_);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_DRAW);
    Context::current().tally().release(bytes_);
    Context::current().tally().allocate(bytes);
    bytes_ = bytes;
}

void Buffer::clear(std::size_t bytes) {
    if (bytes != bytes_) upload(nullptr, bytes);
    constexpr GLuint zero = 0;
    glBindBuffer(GL_COPY_WRITE_BUFFER, id_);
    glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void Buffer::bindStorage(unsigned binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id_); }

VertexArray::VertexArray() { glGenVertexArrays(1, &id_); }

VertexArray::~VertexArray() { glDeleteVertexArrays(1, &id_); }

void VertexArray::bind() const { glBindVertexArray(id_); }

void SceneBuffers::bindInstances() const {
    glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
    for (GLuint row = 0; row < 6; ++row) {
        const GLuint attribute = 1 + row;
        glEnableVertexAttribArray(attribute);
        glVertexAttribPointer(attribute, 4, GL_FLOAT, GL_FALSE, sizeof(InstanceData), offset(row * sizeof(glm::vec4)));
        glVertexAttribDivisor(attribute, 1);
    }
    glEnableVertexAttribArray(7);
    glVertexAttribIPointer(7, 2, GL_UNSIGNED_INT, sizeof(InstanceData), offset(offsetof(InstanceData, idAndMoving)));
    glVertexAttribDivisor(7, 1);
}

SceneBuffers::GpuMesh& SceneBuffers::meshOnGpu(const std::shared_ptr<const Mesh>& mesh) {
    const auto [entry, isNew] = meshes_.try_emplace(mesh.get());
    GpuMesh& gpu = entry->second;
    if (!isNew) return gpu;
    gpu.source = mesh;
    gpu.vertices.upload(mesh->positions.data(), mesh->positions.size() * sizeof(glm::vec3));
    gpu.indices.upload(mesh->triangles.data(), mesh->triangles.size() * sizeof(glm::uvec3));
    gpu.indexCount = static_cast<int>(mesh->triangles.size() * 3);
    gpu.layout.bind();
    glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.id());
    bindInstances();
    return gpu;
}

void SceneBuffers::update(const Snapshot& snapshot) {
    std::vector<InstanceData> instances;
    draws_.clear();
    moving_ = false;
    for (const shadowbench::Batch& batch : snapshot.batches) {
        const auto base = static_cast<unsigned>(instances.size());
        for (const Placement& placement : batch.placements) {
            const bool moved = batch.moves(placement);
            moving_ = moving_ || moved;
            instances.push_back({rows(placement.world), rows(placement.previous), {placement.id, moved ? 1U : 0U}});
        }
        const GpuMesh& mesh = meshOnGpu(batch.mesh); // a reference into the map outlives what is added to it
        const GpuMesh& previous = batch.previousMesh ? meshOnGpu(batch.previousMesh) : mesh;
        draws_.push_back({&mesh, &previous, static_cast<int>(batch.placements.size()), base});
    }
    instances_.upload(instances.data(), instances.size() * sizeof(InstanceData));
}

std::vector<SceneBuffers::Batch> SceneBuffers::batches() const {
    std::vector<Batch> result;
    for (const Draw& draw : draws_)
        result.push_back(
            {draw.mesh->vertices, draw.mesh->indices, draw.mesh->indexCount / 3, draw.instances, draw.baseInstance});
    return result;
}

void SceneBuffers::draw(const Draw& draw) {
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, draw.mesh->indexCount, GL_UNSIGNED_INT, nullptr, draw.instances,
                                        draw.baseInstance);
}

void SceneBuffers::draw() const {
    for (const Draw& one : draws_) {
        one.mesh->layout.bind();
        draw(one);
    }
    Context::current().tally().draws += draws_.size();
}

void SceneBuffers::drawWithMotion() const {
    constexpr GLuint attribute = 8;
    for (const Draw& one : draws_) {
        one.mesh->layout.bind();
        glBindBuffer(GL_ARRAY_BUFFER, one.previousMesh->vertices.id());
        glEnableVertexAttribArray(attribute);
        glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
        draw(one);
    }
    Context::current().tally().draws += draws_.size();
}

void SceneBuffers::draw(const std::vector<bool>& shown) const {
    for (const Draw& draw : draws_) {
        draw.mesh->layout.bind();
        const auto begin = shown.begin() + draw.baseInstance, end = begin + draw.instances;
        for (auto first = std::find(begin, end, true); first != end;) {
            const auto last = std::find(first, end, false);
            glDrawElementsInstancedBaseInstance(GL_TRIANGLES, draw.mesh->indexCount, GL_UNSIGNED_INT, nullptr,
                                                static_cast<GLsizei>(last - first),
                                                static_cast<GLuint>(first - shown.begin()));
            ++Context::current().tally().draws;
            first = std::find(last, end, true);
        }
    }
}

} // namespace shadowbench::gl
