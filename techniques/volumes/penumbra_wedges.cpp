#include "techniques/volumes/penumbra_wedges.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::techniques {
namespace {

/// Tests against the G-buffer's depth and adds to the colour.
void beginAdding() {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
}

void endAdding() {
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

// How far the depth test reaches beyond a surface: far above the rounding of depths, which so decides nothing.
constexpr float slopes = 1, units = 1024;

/// Corners of the parallelogram that bounds a light.
std::array<glm::dvec4, 4> cornersOf(const Light& light) {
    std::array<glm::dvec4, 4> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {light.centre + (i % 2 == 0 ? -0.5 : 0.5) * light.u + (i < 2 ? -0.5 : 0.5) * light.v, 1};
    return corners;
}

} // namespace

glm::dmat4 unitLightFromWorld(const Light& light) {
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, light.centre)); };
    return glm::transpose(glm::dmat4(row(2.0 * light.u / glm::dot(light.u, light.u)),
                                     row(2.0 * light.v / glm::dot(light.v, light.v)),
                                     row(glm::normalize(glm::cross(light.u, light.v))), glm::dvec4(0, 0, 0, 1)));
}

std::vector<Figure> wedgeFigures() {
    return {{"shadow_quads", "hard shadow quads, one a silhouette edge"},
            {"penumbra_wedges", "penumbra wedges, one a silhouette edge and side of the light's plane that it reaches"}};
}

WedgeCount& WedgeCount::operator+=(const WedgeCount& other) {
    quads += other.quads;
    wedges += other.wedges;
    return *this;
}

std::map<std::string, double> WedgeCount::figures() const {
    return {{"shadow_quads", static_cast<double>(quads)}, {"penumbra_wedges", static_cast<double>(wedges)}};
}

PenumbraWedges::PenumbraWedges(Silhouettes silhouettes)
    : silhouettes_(silhouettes), quad_("volumes/shadow_quad.vert", "volumes/shadow_quad.frag") {}

/// What a caster hides of the light it hides within its volume: where no pixel's ray meets that, the caster changes nothing.
void PenumbraWedges::build(const Frame& frame, const Light& light) {
    const auto pass = frame.pass("silhouette edges");
    const Camera& camera = frame.snapshot.camera;
    const ViewPyramid view(camera, frame.aspect(), camera.far);
    const std::array<glm::dvec4, 4> corners = cornersOf(light);
    light_ = light;
    eyeLayers_ = 0;
    edges_.clear();
    for (const Batch& batch : frame.snapshot.batches) {
        const EdgeMesh& mesh = meshes_.of(batch.mesh);
        for (const Placement& placement : batch.placements) {
            if (!VolumeBounds(mesh.bounds(), placement.world, corners).mayMeet(view)) continue;
            const glm::dmat4 objectFromWorld = glm::inverse(placement.world);
            const glm::dvec4 middle = objectFromWorld * glm::dvec4(light.centre, 1);
            const glm::dvec4 eye = objectFromWorld * glm::dvec4(frame.snapshot.camera.eye, 1);
            const std::vector<bool> facing = mesh.facing(middle);
            eyeLayers_ += layersBetween(mesh, facing, glm::dvec3(eye), glm::dvec3(middle));
            addEdges(mesh, facing, placement.world);
        }
    }
    buildWedges(frame.snapshot.bounds());
    uploadQuads();
    uploadWedges();
}

void PenumbraWedges::addEdges(const EdgeMesh& mesh, const std::vector<bool>& facing, const glm::dmat4& world) {
    const auto at = [&](std::uint32_t vertex) {
        return glm::dvec3(world * glm::dvec4(glm::dvec3(mesh.mesh().positions[vertex]), 1));
    };
    const auto planeOf = [&](std::uint32_t triangle) {
        if (triangle == EdgeMesh::none) return glm::vec4(0);
        const glm::uvec3& i = mesh.mesh().triangles[triangle];
        const glm::dvec3 a = at(i.x), normal = glm::cross(at(i.y) - a, at(i.z) - a);
        const double length = glm::length(normal);
        return length == 0 ? glm::vec4(0) : glm::vec4(glm::dvec4(normal, -glm::dot(normal, a)) / length);
    };
    const float averted = mesh.mesh().closed ? 0 : -1;
    for (const LayerEdge& edge : edgesOf(mesh, facing, glm::inverse(world)))
        edges_.push_back({.from = {glm::vec3(at(edge.from)), static_cast<float>(edge.layers)},
                          .to = {glm::vec3(at(edge.to)), averted},
                          .left = planeOf(edge.left),
                          .right = planeOf(edge.right)});
}

std::vector<LayerEdge> PenumbraWedges::edgesOf(const EdgeMesh& mesh, const std::vector<bool>& facing,
                                               const glm::dmat4& objectFromWorld) const {
    if (silhouettes_ == Silhouettes::OfMiddle) return layerEdges(mesh, facing);
    std::vector<std::vector<bool>> facingCorners;
    for (const glm::dvec4& corner : cornersOf(light_)) facingCorners.push_back(mesh.facing(objectFromWorld * corner));
    return layerEdges(mesh, facing, facingCorners);
}

void PenumbraWedges::buildWedges(const Bounds& bounds) {
    wedges_.clear();
    for (const int side : {1, -1}) {
        const WedgeLight light(light_, side);
        double deepest = 0;
        for (const glm::dvec3& corner : bounds.corners()) deepest = std::max(deepest, light.depth(corner));
        const double far = 1.001 * deepest, nearest = 1e-4 * deepest;
        for (const Edge& edge : edges_) {
            const auto wedge = wedgeOver(light, glm::dvec3(edge.from), glm::dvec3(edge.to), nearest, far);
            if (!wedge) continue;
            DrawnWedge& drawn = wedges_.emplace_back(DrawnWedge{edge, {}});
            std::transform(wedge->begin(), wedge->end(), drawn.corners.begin(),
                           [](const glm::dvec3& corner) { return glm::vec4(corner, 1); });
        }
    }
}

void PenumbraWedges::uploadQuads() {
    std::erase_if(edges_, [](const Edge& edge) { return edge.from.w == 0; });
    edgeBuffer_.upload(edges_.data(), edges_.size() * sizeof(Edge));
}

/// A vertex's number tells the shader its wedge and which corner of it.
void PenumbraWedges::uploadWedges() {
    std::vector<std::uint32_t> indices;
    for (std::size_t wedge = 0; wedge < wedges_.size(); ++wedge)
        for (const auto& triangle : wedgeTriangles)
            for (const std::size_t corner : triangle)
                indices.push_back(static_cast<std::uint32_t>(wedge * std::tuple_size_v<Wedge> + corner));
    wedgeBuffer_.upload(wedges_.data(), wedges_.size() * sizeof(DrawnWedge));
    wedgeIndices_.upload(indices.data(), indices.size() * sizeof(std::uint32_t));
}

/// Depth-pass: where a ray from the eye enters what a quad bounds, a layer begins, and where it leaves it, one ends. The
/// layers around the eye are known, so that no volume needs caps. Whether a quad lies before a pixel's point is for the
/// shader to say; the depth test leaves out those that are far behind.
void PenumbraWedges::countLayers(const Frame& frame, const gl::Texture& layers) {
    const auto pass = frame.pass("hard shadow quads");
    const gl::RenderTarget target({&layers, &frame.gbuffer.depthStencil()});
    target.clearColour(0, glm::vec4(static_cast<float>(eyeLayers_)));
    target.bind();
    quad_.set("clipFromWorld", glm::mat4(frame.clipFromWorld))
        .set("middle", glm::vec3(light_.centre))
        .set("positions", frame.gbuffer.position())
        .use();
    edgeBuffer_.bindStorage(0);
    beginAdding();
    glDepthFunc(GL_LESS);
    glPolygonOffset(-slopes, -units);
    glDisable(GL_CULL_FACE);
    gl::Context& context = gl::Context::current();
    glBindVertexArray(context.noAttributes());
    constexpr std::size_t quadVertices = 6;
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(quadVertices * edges_.size()));
    ++context.tally().draws;
    endAdding();
}

void PenumbraWedges::draw(const Frame& frame, gl::Program& program, const gl::RenderTarget& target) const {
    target.bind();
    program.set("clipFromWorld", glm::mat4(frame.clipFromWorld)).use();
    wedgeBuffer_.bindStorage(0);
    beginAdding();
    glDepthFunc(GL_GEQUAL);
    glPolygonOffset(slopes, units);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    wedgeLayout_.bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, wedgeIndices_.id());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * wedgeTriangles.size() * wedges_.size()), GL_UNSIGNED_INT, nullptr);
    ++gl::Context::current().tally().draws;
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    endAdding();
}

} // namespace shadowbench::techniques
