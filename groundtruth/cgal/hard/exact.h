// Exact hard shadows with CGAL, behind plain types (docs/ground-truth.md, "Exact hard shadows").
//
// One geometry serves every oracle and stage: a world vertex is the double-precision image of its float position under
// Placement::world, rounded to nearest as worldVertex (groundtruth/cgal/geometry/triangles.h) spells it out. It lies within
// some 1e-16 of the exact image; a vertex shared by triangles stays shared, so closed meshes stay closed; and predicates
// take doubles as they are. From there on nothing is rounded: pixel rays, receiver points and labels are decided exactly.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <glm/vec4.hpp>
#include <memory>
#include <vector>

namespace shadowbench::groundtruth::geometry {
class SceneTriangles; // groundtruth/cgal/geometry/triangles.h
}

namespace shadowbench::groundtruth::hard {

/// Where `polygon` applies: the part of one surface that lies in one exact plane, as far as it is seen and faces the light
/// (a ground, one face of a box).
struct PlanarReceiver {
    std::uint32_t id = 0;                 // Placement::id
    std::vector<std::uint32_t> triangles; // of the placement's mesh, ascending
    std::size_t pixels = 0;               // that see it
};

/// Whether exact labels come with distances to shadow edges: of a million triangles the distances take longer.
enum class EdgeDistances { Wanted, NotWanted };

/// A snapshot prepared for queries. What several images or receivers share (trees, edges of meshes, silhouettes that no
/// receiver cuts) is made when first needed and kept; const use is thread-safe.
class ExactScene {
public:
    /// `threads`: how many work on an image; results do not depend on it.
    explicit ExactScene(const Snapshot& snapshot, int threads = 2);
    /// With triangles that were made of the same snapshot, or of one with another camera and light only.
    ExactScene(const Snapshot& snapshot, std::shared_ptr<const geometry::SceneTriangles> triangles, int threads = 2);
    ~ExactScene();
    ExactScene(const ExactScene&) = delete;
    ExactScene& operator=(const ExactScene&) = delete;

    /// What every pixel centre sees: the nearest triangle whose distance along the camera's forward axis lies in [near,
    /// far]. Ties go to the lower surface id, then to the lower triangle index. An area light is faced if the corners of its
    /// rectangle are (for a disk: of the square around it; for a line: its ends); an environment always is.
    [[nodiscard]] PrimaryHits primaryHits(glm::ivec2 size, const Progress& progress = {}) const;

    /// Exact labels at the receivers of `primary` by shadow rays: 1 lit, 0 shadowed (0 where there is no receiver);
    /// `surface` becomes OnEdge where the segment to the light meets nothing but an occluder's border. The edge distance is
    /// that to the nearest midpoint between neighbouring pixels of different labels, up to 8 px, infinity beyond. Images of
    /// `out` that have no size yet are made. Point and directional lights; else InternalError.
    void labelByRays(glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress = {}) const;

    /// The planes that at least `minimumPixels` receiver pixels of one surface see, ordered by surface id.
    [[nodiscard]] std::vector<PlanarReceiver> planarReceivers(const PrimaryHits& primary,
                                                              std::size_t minimumPixels = 256) const;

    /// The labels of `labelByRays` by another method, exact winding numbers of silhouette chains: no decision, tree or
    /// shadow ray is shared. With the distance to the nearest visible boundary of the union of the shadows on the receiver's
    /// plane: correct to 1e-6 px up to 8 px, infinity beyond. A boundary is visible where one of the four pixel centres
    /// around it sees the receiver. Where distances are not wanted they are infinity off the edges. Writes the pixels of
    /// `receiver` only; images of `out` that have no size yet are made. InternalError if winding numbers found on different
    /// paths disagree.
    void labelByPolygon(glm::ivec2 size, const PrimaryHits& primary, const PlanarReceiver& receiver, Reference& out,
                        const Progress& progress = {}, EdgeDistances distances = EdgeDistances::Wanted) const;

    /// Replaces the labels in `out` by the mean over the part of each pixel's square in which the surface of its centre is
    /// seen and faces the light: by polygons, with rays in pixels that see more triangles than are worth cutting. Sigma is 0
    /// where that is exact, else at most 0.01; pixels on an edge become receivers again. Point and directional lights; else
    /// InternalError.
    void averageOverPixels(glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress = {}) const;

    /// The same of one pixel by `side`² exact rays alone, with which `averageOverPixels` shares no decision. Each `set` of
    /// rays is another one.
    struct PixelMean {
        double mean = 0;  // 0 where no ray meets a surface that faces the light
        double sigma = 0; // that independent rays would have; these, one in each cell of a grid, have less
        double seen = 0;  // share of the rays that meet one
    };
    [[nodiscard]] PixelMean meanByRays(glm::ivec2 size, glm::ivec2 pixel, std::uint32_t surface, int side,
                                       std::uint16_t set = 0) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// The same without keeping the trees.
PrimaryHits primaryHits(const Snapshot& snapshot, glm::ivec2 size, const Progress& progress = {});
void labelByRays(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, Reference& out,
                 const Progress& progress = {});
std::vector<PlanarReceiver> planarReceivers(const Snapshot& snapshot, const PrimaryHits& primary,
                                            std::size_t minimumPixels = 256);
void labelByPolygon(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, const PlanarReceiver& receiver,
                    Reference& out, const Progress& progress = {});

/// Versions for the provenance and the key: CGAL's and of this code.
std::map<std::string, std::string> toolVersions();

} // namespace shadowbench::groundtruth::hard
