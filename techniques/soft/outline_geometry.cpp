#include "techniques/soft/outline_geometry.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::techniques {

std::optional<std::string> notRound(const Scene& scene) {
    if (scene.light.kind != LightKind::Line) return std::nullopt;
    return "the penumbra is that of a round light, and a line has no extent across";
}

double lightRadius(const Light& light) { return 0.25 * (glm::length(light.u) + glm::length(light.v)); }

OutlineGeometry::OutlineGeometry() {
    layout_.bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
    const auto attribute = [](GLuint location, GLint components, std::size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(AttachedVertex),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(AttachedVertex, point));
    attribute(9, 3, offsetof(AttachedVertex, offset));
    attribute(10, 1, offsetof(AttachedVertex, value));
}

void OutlineGeometry::build(const Frame& frame, const LightView& view, const Attach& attach) {
    const auto pass = frame.pass("silhouette edges");
    view_ = view;
    lightFromWorld_ = lightFromWorld(frame.snapshot.light, glm::dvec3(view.depthFromWorld));
    if (!bound_) {
        layout_.bind();
        frame.scene.bindInstances();
        bound_ = true;
    }
    const double nearest = 1e-4 * view.far; // as casters are cut
    ranges_.clear();
    std::vector<AttachedVertex> vertices;
    for (const Batch& batch : frame.snapshot.batches) {
        const EdgeMesh& mesh = meshes_.of(batch.mesh);
        const glm::dvec4 middle(batch.mesh->bounds().centre(), 1);
        for (const Placement& placement : batch.placements) {
            const glm::dmat4 lightFromObject = lightFromWorld_ * placement.world;
            const SeenOutline outline = seenOutline(mesh, lightFromObject, nearest);
            const std::size_t first = vertices.size();
            attach({outline, std::max(nearest, (lightFromObject * middle).z), nearest, view.far}, vertices);
            ranges_.push_back({first, vertices.size() - first});
        }
    }
    buffer_.upload(vertices.data(), vertices.size() * sizeof(AttachedVertex));
}

void OutlineGeometry::draw(gl::Program& program, const LinearisedMap& map) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MIN);
    program.set("clipFromWorld", glm::mat4(view_.clipFromWorld))
        .set("depthFromWorld", glm::vec4(view_.depthFromWorld))
        .set("worldFromLight", glm::mat4(glm::inverse(lightFromWorld_)));
    map.bindTo(program);
    program.use();
    layout_.bind();
    for (std::size_t placement = 0; placement < ranges_.size(); ++placement) {
        const Range& range = ranges_[placement];
        if (range.count == 0) continue;
        glDrawArraysInstancedBaseInstance(GL_TRIANGLES, static_cast<GLint>(range.first), static_cast<GLsizei>(range.count),
                                          1, static_cast<GLuint>(placement));
        ++gl::Context::current().tally().draws;
    }
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_CLAMP);
}

std::vector<Parameter> receiverBiasParameters() {
    std::vector<Parameter> parameters = depthMapParameters();
    for (Parameter& parameter : parameters) {
        if (parameter.name == "bias") parameter.meaning = "bias of the receiver's depth";
        if (parameter.name == "factor") parameter.meaning = "of the receiver's depth slope per half texel (bias=slope)";
    }
    return parameters;
}

void bindOutlineReceiver(gl::Program& program, const Frame& frame, const LightView& view, const LinearisedMap& map,
                         Bias bias) {
    const glm::dmat4 toLight = lightFromWorld(frame.snapshot.light, glm::dvec3(view.depthFromWorld));
    map.bindTo(program);
    program.set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("mapFromWorld", mapFromWorld(view))
        .set("lightFromWorld", glm::mat4(toLight))
        .set("texel", glm::vec2(view.span / static_cast<double>(map.side())))
        .set("bias", glm::vec2(bias.factor, bias.units * depthStep * view.far));
}

} // namespace shadowbench::techniques
