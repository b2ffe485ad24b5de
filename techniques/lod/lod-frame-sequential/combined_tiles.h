// Where on the screen two LOD buffers may combine to something else than the newer one shows: around what is in transition.
// No GL.
#pragma once

#include "scene/mesh.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace shadowbench::techniques {

/// A part of the screen, which is [−1, 1]²; it may reach beyond.
struct ScreenRectangle {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

/// Around the convex hull of points in clip space; all of the screen where one of them is not before the eye.
ScreenRectangle rectangleAround(std::span<const glm::dvec4> clip);

/// What a camera sees of a box.
struct SeenBox {
    ScreenRectangle pixels; // a pixel wider on every side than the box
    double nearest;         // metres along the view direction; 0 where the box is not wholly before the eye
};
SeenBox seenBox(const Bounds& box, const glm::dmat4& clipFromObject, glm::ivec2 size);

/// Where another camera may see what lies behind a box, or within. `projection` is the first camera's; `otherFromClip` leads
/// from its clip space to that of the other.
ScreenRectangle rectangleBehind(const SeenBox& box, const glm::dmat4& projection, const glm::dmat4& otherFromClip);

/// Tiles of an image, marked or not.
class CombinedTiles {
public:
    static constexpr int side = 4; // pixels, of a tile: what software rasterisers shade at once

    explicit CombinedTiles(glm::ivec2 size);

    /// Marks all tiles that the rectangle touches.
    void mark(const ScreenRectangle& rectangle);

    /// The marked tiles as rectangles: left, bottom, right and top on the screen. None overlap.
    [[nodiscard]] std::vector<glm::vec4> rectangles() const;

private:
    /// Tiles beside each other in a row, from the first to before the last.
    using Run = std::pair<int, int>;
    [[nodiscard]] std::vector<Run> runsOf(int row) const;
    [[nodiscard]] float onScreen(int tile, int axis) const;

    glm::ivec2 size_, count_;
    std::vector<bool> marked_;
};

} // namespace shadowbench::techniques
