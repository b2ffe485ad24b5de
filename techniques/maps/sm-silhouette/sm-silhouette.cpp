// Shadow silhouette maps (Sen, Cammarano, Hanrahan 2003): beside the depth map a map of its dual grid that holds, for each
// cell that an outline crosses, one point of it; four depth samples and five such points give a piecewise linear shadow
// edge. Course, "Shadow Silhouette Maps". Departures: outlines are projected by the CPU; borders of open
// meshes are outlines too.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"
#include "techniques/maps/sm-silhouette/dual_edge.h"
#include "techniques/shared/casters/edge_meshes.h"
#include "techniques/shared/casters/outline.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/normal_offset.h"
#include "techniques/shared/maps/single_map.h"

#include <cstdint>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace shadowbench::techniques {
namespace {

class SilhouetteMap final : public Technique {
public:
    explicit SilhouetteMap(const Parameters& p)
        : bias_(biasFrom(p)), map_(p.integer("map"), bias_, Lookup::Raw),
          points_(gl::Format::RG16F, glm::ivec2(map_.side() + 1)), target_{&points_},
          edge_("maps/sm-silhouette/edge.vert", "maps/sm-silhouette/edge.frag"),
          resolve_(gl::Program::screen("maps/sm-silhouette/sm-silhouette.frag", normalOffsetDefines(bias_))) {
        layout_.bind();
        glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
        for (GLuint end = 0; end < 2; ++end) {
            glEnableVertexAttribArray(end);
            glVertexAttribPointer(end, 3, GL_FLOAT, GL_FALSE, sizeof(DualEdge),
                                  reinterpret_cast<const void*>(end * sizeof(glm::vec3)));
            glVertexAttribDivisor(end, 1);
        }
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        map_.draw(light_, frame);
        uploadOutlines(frame);
        drawSilhouetteMap(frame);
        bindTo(resolve_, frame);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        constexpr double depth = 4, point = 4; // bytes
        const CasterFragments casters = map_.fragments(light_, frame);
        const double cells = outlineFragments({{"CROSSED", "1"}}), points = outlineFragments({});
        const double tested = pixels(frame, {{"TESTED", "1"}}), branch = pixels(frame, {{"BRANCH", "1"}});
        const double facing = pixels(frame, {{"TESTED", "1"}, {"FACING", "1"}});
        const double facingBranch = pixels(frame, {{"BRANCH", "1"}, {"FACING", "1"}});
        std::map<std::string, double> figures{
            {"map_bytes",
             depth * static_cast<double>(casters.rasterised + casters.written) + 4 * depth * cells + point * points},
            {"lookup_bytes", 4 * depth * tested + 5 * point * branch}};
        if (facing > 0) figures["silhouette_branch"] = facingBranch / facing;
        if (tested > facing) figures["averted_branch"] = (branch - facingBranch) / (tested - facing);
        return figures;
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, glm::dvec2(map_.side()));
    }

private:
    /// Finds the outlines of all placements, in the map drawn last, for `drawOutlines`.
    void uploadOutlines(const Frame& frame) {
        const auto pass = frame.pass("silhouette edges");
        const std::vector<DualEdge> edges = outlines(frame, light_);
        edgeCount_ = edges.size();
        buffer_.upload(edges.data(), edges.size() * sizeof(DualEdge));
    }

    std::vector<DualEdge> outlines(const Frame& frame, const LightView& view) {
        const glm::dvec4 light = frame.hardLight.homogeneous();
        std::vector<DualEdge> result;
        for (const Batch& batch : frame.snapshot.batches) {
            const EdgeMesh& mesh = meshes_.of(batch.mesh);
            for (const Placement& placement : batch.placements) {
                const auto world = [&](std::uint32_t vertex) {
                    return glm::dvec3(placement.world * glm::dvec4(batch.mesh->positions[vertex], 1));
                };
                for (const OutlineEdge& e : outline(mesh, mesh.facing(glm::inverse(placement.world) * light)))
                    if (const auto edge = onDualGrid(view, world(e.from), world(e.to), map_.side())) result.push_back(*edge);
            }
        }
        return result;
    }

    void drawSilhouetteMap(const Frame& frame) {
        const auto pass = frame.pass("silhouette map");
        drawOutlines(edge_);
    }

    /// Every cell starts with its middle; later edges overwrite earlier ones.
    void drawOutlines(gl::Program& edge) const {
        target_.clearColour(0, glm::vec4(0.5F));
        target_.bind();
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        if (edge.uses("depthMap")) edge.set("depthMap", map_.texture());
        edge.set("cells", points_.size().x).use();
        layout_.bind();
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(edgeCount_));
        ++gl::Context::current().tally().draws;
    }

    void bindTo(gl::Program& program, const Frame& frame) const {
        program.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_.texture());
        setNormalOffset(program, frame, bias_, map_.texture().size());
        if (program.uses("silhouetteMap")) program.set("silhouetteMap", points_);
        if (!program.uses("light")) return;
        program.set("light", glm::vec4(frame.hardLight.homogeneous())).set("normals", frame.gbuffer.normal());
    }

    [[nodiscard]] double outlineFragments(const gl::Defines& defines) const {
        gl::Program edge("maps/sm-silhouette/edge.vert", "maps/sm-silhouette/edge.frag", defines);
        gl::FragmentMeter meter;
        drawOutlines(edge);
        return static_cast<double>(meter.finish());
    }

    /// Pixels of the image that get as far as `defines` says (sm-silhouette.frag).
    [[nodiscard]] double pixels(const Frame& frame, const gl::Defines& defines) const {
        const gl::Texture image(gl::Format::R8, frame.size);
        gl::Defines all = normalOffsetDefines(bias_);
        all.insert(all.end(), defines.begin(), defines.end());
        gl::Program counted = gl::Program::screen("maps/sm-silhouette/sm-silhouette.frag", all);
        bindTo(counted, frame);
        gl::FragmentMeter meter;
        resolve(frame, {&image}, counted);
        return static_cast<double>(meter.finish());
    }

    Bias bias_;
    LightView light_;
    std::size_t edgeCount_ = 0;
    DepthMap map_;
    gl::Texture points_;
    gl::RenderTarget target_;
    gl::Program edge_, resolve_;
    gl::Buffer buffer_;
    gl::VertexArray layout_;
    EdgeMeshes meshes_;
};

} // namespace

Entry smSilhouette() {
    return {.id = "sm-silhouette",
            .title = "Shadow silhouette map",
            .source = {Document::Course, "Shadow Silhouette Maps"},
            .answer = Answer::Hard,
            .parameters = withNormalOffset(depthMapParameters()),
            .figures = {{"silhouette_branch", "share of the pixels facing the light whose four depth tests differ"},
                        {"averted_branch", "the same share of the pixels facing away from the light, which need no test"},
                        {"map_bytes", "bytes that drawing both maps reads and writes: 4 for a depth, 4 for a point"},
                        {"lookup_bytes", "bytes that the pixels' tests read from both maps"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<SilhouetteMap>(p); }};
}

} // namespace shadowbench::techniques
