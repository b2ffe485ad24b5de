#include "techniques/lod/level_drawer.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/lod/transition.h"

#include <cstddef>
#include <glm/mat3x4.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::techniques {
namespace {

/// What the vertex shader reads of one instance (lod/instance.vert).
struct InstanceData {
    glm::mat3x4 world; // three rows of the affine matrix
    glm::vec4 colourAndVisibility;
    std::uint32_t id;
};

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

void instanceAttribute(GLuint location, std::size_t start) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, 4, GL_FLOAT, GL_FALSE, sizeof(InstanceData), offset(start));
    glVertexAttribDivisor(location, 1);
}

/// The draws of one mesh.
struct Group {
    const Mesh* mesh;
    std::vector<InstanceData> instances;
};

std::vector<Group> grouped(std::span<const LodChain> chains, std::span<const LevelDraw> draws) {
    std::vector<Group> groups;
    std::unordered_map<const Mesh*, std::size_t> places;
    for (const LevelDraw& draw : draws) {
        const LodLevel& level = chains[draw.instance->chain][static_cast<std::size_t>(draw.level)];
        const auto [place, isNew] = places.try_emplace(level.mesh.get(), groups.size());
        if (isNew) groups.push_back({level.mesh.get(), {}});
        groups[place->second].instances.push_back(
            {glm::mat3x4(glm::transpose(draw.instance->world)), glm::vec4(level.colour, draw.visibility), draw.id});
    }
    return groups;
}

} // namespace

LevelDraw switched(const LodInstance& instance) {
    const LodSelection& selection = instance.selection;
    return {&instance, selection.level + (showsCoarser(selection.progress) ? 1 : 0)};
}

LevelDrawer::LevelDrawer(std::span<const LodChain> chains) {
    for (const LodChain& chain : chains)
        for (const LodLevel& level : chain) upload(*level.mesh);
}

void LevelDrawer::upload(const Mesh& mesh) {
    const auto [entry, isNew] = meshes_.try_emplace(&mesh);
    if (!isNew) return;
    GpuMesh& gpu = entry->second;
    gpu.vertices.upload(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    gpu.indices.upload(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    gpu.indexCount = static_cast<int>(mesh.triangles.size() * 3);
    gpu.layout.bind();
    glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.id());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
    for (GLuint row = 0; row < 3; ++row) instanceAttribute(1 + row, offsetof(InstanceData, world) + row * sizeof(glm::vec4));
    instanceAttribute(4, offsetof(InstanceData, colourAndVisibility));
    glEnableVertexAttribArray(5);
    glVertexAttribIPointer(5, 1, GL_UNSIGNED_INT, sizeof(InstanceData), offset(offsetof(InstanceData, id)));
    glVertexAttribDivisor(5, 1);
}

void LevelDrawer::draw(std::span<const LodChain> chains, std::span<const LevelDraw> draws) {
    const std::vector<Group> groups = grouped(chains, draws);
    std::vector<InstanceData> instances;
    instances.reserve(draws.size());
    for (const Group& group : groups) instances.insert(instances.end(), group.instances.begin(), group.instances.end());
    instances_.upload(instances.data(), instances.size() * sizeof(InstanceData));
    unsigned base = 0;
    for (const Group& group : groups) {
        const GpuMesh& gpu = meshes_.at(group.mesh);
        const auto count = static_cast<int>(group.instances.size());
        gpu.layout.bind();
        glDrawElementsInstancedBaseInstance(GL_TRIANGLES, gpu.indexCount, GL_UNSIGNED_INT, nullptr, count, base);
        base += static_cast<unsigned>(count);
    }
    gl::Context::current().tally().draws += groups.size();
}

} // namespace shadowbench::techniques
