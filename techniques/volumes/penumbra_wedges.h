// The two parts of soft shadow volumes (course, Soft Shadow Volumes): hard shadow quads, which count what hides a light's
// middle, and penumbra wedges, in which a shader adds what an edge changes for the rest of the light.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/shared/casters/edge_meshes.h"
#include "techniques/shared/casters/volume_bounds.h"
#include "techniques/shared/casters/wedges.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::techniques {

/// World to the light's own: x and y in which the light is [−1, 1]², or the disk within, and z along its normal in metres.
glm::dmat4 unitLightFromWorld(const Light& light);

/// How much a frame draws.
struct WedgeCount {
    std::size_t quads = 0, wedges = 0;

    WedgeCount& operator+=(const WedgeCount& other);
    [[nodiscard]] std::map<std::string, double> figures() const; // `wedgeFigures`
};
std::vector<Figure> wedgeFigures();

/// Which edges have wedges.
enum class Silhouettes {
    OfMiddle, // those where layers end as the light's middle sees them
    OfLight,  // and those where they may end for another point of the light
};

class PenumbraWedges {
public:
    explicit PenumbraWedges(Silhouettes silhouettes);

    /// Finds the edges of all placements for `light`, a rectangle or a disk, and builds their wedges. Casters that hide the
    /// light from nothing that the camera sees are left out.
    void build(const Frame& frame, const Light& light);

    /// Writes to each pixel how many layers (`layerEdges`) hide the light's middle from its surface point.
    void countLayers(const Frame& frame, const gl::Texture& layers);

    /// Draws the wedges with a program of volumes/wedge.vert, whose further uniforms are set, into `target`, adding to
    /// its colour: a fragment for each pixel whose point lies before the far side of a wedge. The target has the G-buffer's
    /// depth, which is not written.
    void draw(const Frame& frame, gl::Program& program, const gl::RenderTarget& target) const;

    /// Of the light built for last.
    [[nodiscard]] WedgeCount count() const { return {edges_.size(), wedges_.size()}; }

private:
    /// As volumes/edges.glsl has it.
    struct Edge {
        glm::vec4 from, to; // world; from.w: its layers, to.w: those of a triangle that does not face the light, 0 or −1
        glm::vec4 left, right; // planes of the triangles on either side, (n, d) of n · x + d = 0; 0 where there is none
    };
    /// As volumes/wedge.vert reads it.
    struct DrawnWedge {
        Edge edge;
        std::array<glm::vec4, std::tuple_size_v<Wedge>> corners;
    };

    void addEdges(const EdgeMesh& mesh, const std::vector<bool>& facing, const glm::dmat4& world);
    [[nodiscard]] std::vector<LayerEdge> edgesOf(const EdgeMesh& mesh, const std::vector<bool>& facing,
                                                 const glm::dmat4& objectFromWorld) const;
    void buildWedges(const Bounds& bounds);
    void uploadQuads();
    void uploadWedges();

    Silhouettes silhouettes_;
    EdgeMeshes meshes_;
    Light light_;
    int eyeLayers_ = 0; // between the eye and the light's middle
    std::vector<Edge> edges_;
    std::vector<DrawnWedge> wedges_;
    gl::Buffer edgeBuffer_, wedgeBuffer_, wedgeIndices_;
    gl::VertexArray wedgeLayout_;
    gl::Program quad_;
};

} // namespace shadowbench::techniques
