// The visible share of a point or directional light over a pixel's square (docs/ground-truth.md, "Pixel areas"), in two ways
// that share no code: areas of the polygons that the pixel sees, and exact rays at many image positions.
#pragma once

#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/pixel_patches.h"
#include "scene/camera.h"

#include <glm/vec4.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

namespace shadowbench::groundtruth::hard {

using namespace geometry;

/// By polygons: the triangles in the pixel, cut by its square; on each that faces the light the shadows of those between it
/// and the light. Which vertices lie on a triangle's plane, and which surfaces face the light, is decided exactly; positions
/// are rounded to double. Const use is thread-safe.
class PixelAreas {
public:
    /// `scene` must live longer; `light` is homogeneous.
    PixelAreas(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size);

    /// A few pixels beside each other, for which triangles are looked up, and shadows projected, once.
    class Tile {
    public:
        /// `areas` must live longer; all pixels lie in the rectangle.
        Tile(const PixelAreas& areas, const ImageRectangle& rectangle);

        /// Of what the pixel sees of the surface with this id. Nothing for a pixel with more triangles than are worth
        /// cutting: it is for rays.
        [[nodiscard]] std::optional<AreaShares> of(glm::ivec2 pixel, std::uint32_t surface);

    private:
        struct SeenTriangle {
            Triangle triangle;
            glm::dvec3 normal; // of length 1, towards the light where the triangle faces it
            HomogeneousPolygon image;
            glm::dvec3 inverseDepth; // Patch::inverseDepth
            int lightSide;
            bool facesLight; // where it is seen
            std::uint32_t surface;
            std::unordered_map<std::uint64_t, HomogeneousPolygon> shadows; // on its plane, of the casters so far
        };
        void addShadows(const ImageRectangle& square, SeenTriangle& seen, Patch& patch) const;

        friend class PixelAreas;
        const PixelAreas& areas_;
        std::vector<SeenTriangle> triangles_;
    };

private:
    using SeenTriangle = Tile::SeenTriangle;
    [[nodiscard]] glm::dvec3 inImage(const glm::dvec3& world) const;
    [[nodiscard]] glm::dvec3 inWorld(const Patch& patch, glm::dvec2 at) const;
    [[nodiscard]] Shaft eyeShaft(const ImageRectangle& rectangle) const;
    [[nodiscard]] std::optional<SeenTriangle> seen(const Triangle& triangle, const ImageRectangle& rectangle) const;
    [[nodiscard]] Shaft lightShaft(const SeenTriangle& seen, const Patch& patch) const;
    [[nodiscard]] HomogeneousPolygon shadow(const Triangle& caster, const SeenTriangle& seen) const;

    const SceneTriangles& scene_;
    glm::dvec3 eye_;
    double near_, far_;
    glm::dvec4 light_;
    glm::dvec3 rowX_, rowY_, rowDepth_;  // products of an offset from the eye with these are x w, y w and w
    glm::dvec3 ray_, rayPerX_, rayPerY_; // through image position (x, y), of length 1 along the camera's axis
    double slack_;                       // of half-spaces, for normals of length 1
};

/// By rays: exact primary hits and labels at `side`² image positions, one drawn in each cell of a grid, seeded by the pixel
/// and the `set`; at the pixel's centre too where they agree on all or nothing. Sigma is what independent positions would
/// leave: more than what these do.
AreaShares sharesByRays(const SceneTriangles& scene, const Camera& camera, const Light& light, glm::ivec2 size,
                        glm::ivec2 pixel, std::uint32_t surface, int side, std::uint16_t set = 0);

} // namespace shadowbench::groundtruth::hard
