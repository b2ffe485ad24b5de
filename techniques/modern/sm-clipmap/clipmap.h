// Levels of pages over the image planes of a hard light: a clipmap around the eye under the sun, all of each plane for other
// lights.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/page.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

struct ClipmapRule {
    int texels = 128;   // along a page
    int extent = 4096;  // texels along a level
    int levels = 16;    // at most
    double density = 1; // texels that lie along a pixel, at least
};

/// The pages of a level that may be drawn: a square of them.
struct PageWindow {
    int level;
    glm::ivec2 first; // the least column and row
    int pages;        // along a side
};

/// Where a point lies, and the level that it asks for.
struct PointInPages {
    int plane;
    glm::dvec2 at; // column and row of level 0, and where in that page
    std::size_t window;
};

/// A page of level l is 2^l as wide as one of level 0. Under the sun texels of level 0 are a metre wide, and columns and
/// rows count from the world's origin, so that a page is the same square of the world wherever the eye is; of another
/// light's plane level 0 is one page.
class Clipmap {
public:
    /// Of a frame of `size` pixels. The coarsest level holds all that the camera sees of the scene's box, with texels no
    /// shorter than the farthest pixel asks for.
    Clipmap(const ClipmapRule& rule, const Light& light, const Snapshot& snapshot, glm::ivec2 size);

    /// For each plane the view of column 0, row 0 of level 0.
    [[nodiscard]] const std::vector<LightView>& planes() const { return planes_; }

    /// Those of every plane, from the finest to the coarsest.
    [[nodiscard]] const std::vector<PageWindow>& windows() const { return windows_; }

    [[nodiscard]] LightView viewOf(const Page& page) const;

    /// How many entries a table over all pages has: plane by plane, window by window, row by row.
    [[nodiscard]] std::size_t entries() const;
    [[nodiscard]] Page pageOf(std::size_t entry) const;

    /// The entry of a page of a window; nothing where it lies beside the window.
    [[nodiscard]] std::optional<std::size_t> entryOf(int plane, std::size_t window, const glm::ivec2& at) const;

    /// What the shader of a pixel that shows `world` finds: placeOf() of modern/sm-clipmap/pages.glsl.
    [[nodiscard]] PointInPages placeOf(const glm::dvec3& world) const;

    /// The column and row of a window in which a point lies, and where in that page.
    [[nodiscard]] glm::dvec2 inWindow(const PointInPages& point, std::size_t window) const;

    /// Sets the uniforms of modern/sm-clipmap/pages.glsl.
    void bindTo(gl::Program& program) const;

private:
    void aroundEye(const Snapshot& snapshot, double aspect);
    void overPlanes();
    [[nodiscard]] glm::dvec2 onPlane(int plane, const glm::dvec3& world) const;
    [[nodiscard]] glm::dvec4 texelFromWorld(int plane) const;
    [[nodiscard]] glm::dvec2 ends() const;
    [[nodiscard]] int side() const { return rule_.extent / rule_.texels; } // pages along a level

    ClipmapRule rule_;
    glm::dvec4 light_;             // homogeneous
    glm::dvec4 pixelFromWorld_{0}; // dot with (p, 1): metres along a pixel at that depth, over the density
    std::vector<LightView> planes_;
    std::vector<PageWindow> windows_;
};

} // namespace shadowbench::techniques
