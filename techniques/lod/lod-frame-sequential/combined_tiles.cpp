#include "techniques/lod/lod-frame-sequential/combined_tiles.h"

#include <algorithm>
#include <map>

namespace shadowbench::techniques {

ScreenRectangle rectangleAround(std::span<const glm::dvec4> clip) {
    ScreenRectangle result;
    for (const glm::dvec4& point : clip) {
        if (point.w <= 0) return {glm::dvec2(-1), glm::dvec2(1)};
        const glm::dvec2 at = glm::dvec2(point) / point.w;
        result.low = glm::min(result.low, at);
        result.high = glm::max(result.high, at);
    }
    return result;
}

SeenBox seenBox(const Bounds& box, const glm::dmat4& clipFromObject, glm::ivec2 size) {
    std::array<glm::dvec4, 8> clip;
    std::ranges::transform(box.corners(), clip.begin(),
                           [&](const glm::dvec3& corner) { return clipFromObject * glm::dvec4(corner, 1); });
    const auto byDepth = [](const glm::dvec4& a, const glm::dvec4& b) { return a.w < b.w; };
    SeenBox seen{rectangleAround(clip), std::max(0.0, std::ranges::min_element(clip, byDepth)->w)};
    const glm::dvec2 pixel = 2.0 / glm::dvec2(size);
    seen.pixels.low -= pixel;
    seen.pixels.high += pixel;
    return seen;
}

ScreenRectangle rectangleBehind(const SeenBox& box, const glm::dmat4& projection, const glm::dmat4& otherFromClip) {
    std::array<glm::dvec4, 8> other; // the rectangle's corners at the nearest depth, and infinitely far away
    for (std::size_t i = 0; i < other.size(); ++i) {
        const double x = i % 2 == 0 ? box.pixels.low.x : box.pixels.high.x;
        const double y = i / 2 % 2 == 0 ? box.pixels.low.y : box.pixels.high.y;
        const glm::dvec4 far(x, y, -projection[2][2], 1);
        other[i] = otherFromClip * (i < 4 ? box.nearest * far + glm::dvec4(0, 0, projection[3][2], 0) : far);
    }
    return rectangleAround(other);
}

CombinedTiles::CombinedTiles(glm::ivec2 size)
    : size_(size), count_((size + side - 1) / side), marked_(static_cast<std::size_t>(count_.x) * count_.y) {}

void CombinedTiles::mark(const ScreenRectangle& rectangle) {
    const auto tileOf = [&](double at, int axis) {
        const double pixel = std::clamp(0.5 * (at + 1), 0.0, 1.0) * size_[axis];
        return std::min(static_cast<int>(pixel) / side, count_[axis] - 1);
    };
    if (rectangle.high.x < -1 || rectangle.high.y < -1 || rectangle.low.x > 1 || rectangle.low.y > 1) return;
    for (int y = tileOf(rectangle.low.y, 1); y <= tileOf(rectangle.high.y, 1); ++y)
        for (int x = tileOf(rectangle.low.x, 0); x <= tileOf(rectangle.high.x, 0); ++x)
            marked_[static_cast<std::size_t>(y) * count_.x + x] = true;
}

float CombinedTiles::onScreen(int tile, int axis) const {
    return 2.0F * static_cast<float>(std::min(tile * side, size_[axis])) / static_cast<float>(size_[axis]) - 1;
}

std::vector<CombinedTiles::Run> CombinedTiles::runsOf(int row) const {
    const auto isMarked = [&](int column) {
        return column < count_.x && marked_[static_cast<std::size_t>(row) * count_.x + column];
    };
    std::vector<Run> runs;
    for (int column = 0; column < count_.x; ++column) {
        const int first = column;
        while (isMarked(column)) ++column;
        if (column > first) runs.emplace_back(first, column);
    }
    return runs;
}

/// A run that lies just above an equal one makes its rectangle higher.
std::vector<glm::vec4> CombinedTiles::rectangles() const {
    std::vector<glm::vec4> result;
    std::map<Run, std::size_t> below; // of the row before, the rectangles that they belong to
    for (int row = 0; row < count_.y; ++row) {
        std::map<Run, std::size_t> here;
        for (const Run& run : runsOf(row)) {
            const auto grown = below.find(run);
            here[run] = grown == below.end() ? result.size() : grown->second;
            if (grown == below.end())
                result.emplace_back(onScreen(run.first, 0), onScreen(row, 1), onScreen(run.second, 0), 0);
            result[here[run]].w = onScreen(row + 1, 1);
        }
        below = std::move(here);
    }
    return result;
}

} // namespace shadowbench::techniques
