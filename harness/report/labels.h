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
    [[nodiscard]] bool meets(glm::dvec2 a, glm::dvec2 b) const; // a horizontal or vertical segment
};

struct LabelledPoint {
    glm::dvec2 at;
    std::string text;
};

/// Where a label lies, and whether it is so far from its point that a line must lead to it.
struct PlacedLabel {
    Box box;
    bool leader;
};

/// Puts every label on the free place nearest to its point: inside `area`, off the points and the labels placed before, and,
/// if it can be had, off the `lines` of the chart too. `letter` is the size of a character.
std::vector<PlacedLabel> placeLabels(const std::vector<LabelledPoint>& points, const Box& area,
                                     const std::vector<std::pair<glm::dvec2, glm::dvec2>>& lines, glm::dvec2 letter);

} // namespace shadowbench::report
