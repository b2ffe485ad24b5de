// Labels beside the points of a chart, placed so that they can be read.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::report {

/// All in pixels, y down.
struct Box {
    glm::dvec2 low, high;
    [[nodiscard]] bool overlaps(const Box& other) const;
    [[nodiscard]] bool contains(const Box& other) const;
    [[nodiscard]] bool meets(glm::dvec2 a, glm::dvec2 b) const; // the segment's bounding box
    [[nodiscard]] glm::dvec2 closest(glm::dvec2 point) const;
};

struct LabelledPoint {
    glm::dvec2 at;
    std::string text;
};

/// Where a label lies, on which side of its point (−1, 0 or 1 right and down), and whether it is so far from it that a line
/// must lead there. The text belongs at the side of the box that is nearer to the point.
struct PlacedLabel {
    Box box;
    glm::ivec2 side;
    bool leader;
};

/// Puts every label on the free place nearest to its point: inside `area`, off the points and the labels placed before, and,
/// if it can be had, off the `lines` of the chart too. `letter` is the size of a character.
std::vector<PlacedLabel> placeLabels(const std::vector<LabelledPoint>& points, const Box& area,
                                     const std::vector<std::pair<glm::dvec2, glm::dvec2>>& lines, glm::dvec2 letter);

/// Puts the labels of points that share a column one below another at the left side of `area`, in the order of the points'
/// heights and each as near to its own as the others allow (least squares of the distances). They are `letter.y` apart, or
/// nearer where `area` has less room.
std::vector<PlacedLabel> placeInColumn(const std::vector<LabelledPoint>& points, const Box& area, glm::dvec2 letter);

} // namespace shadowbench::report
