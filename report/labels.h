// Labels beside the points of a chart, placed so that they can be read.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::report {

/// All in pixels, y down.
struct Box {
    glm::dvec2 low, high;
    [[nodiscard]] bool overlaps(const Box& other) const;
    [[nodiscard]] bool contains(const Box& other) const;
    [[nodiscard]] glm::dvec2 closest(glm::dvec2 point) const;
};

inline constexpr double labelSize = 12, lineHeight = 14; // of a label's letters, pixels

/// Pixels that a text of letters of `size` takes in Liberation Sans, which charts ask for first; letters beyond ASCII count
/// as square.
double textWidth(const std::string& text, double size);

struct LabelledPoint {
    glm::dvec2 at;
    std::string text;
    glm::dvec2 size; // of the text
};
LabelledPoint labelled(glm::dvec2 at, const std::string& text);

/// Where a label lies, on which side of its point (−1, 0 or 1 right and down), and whether it is so far from it that a line
/// must lead there. The text belongs at the side of the box that is nearer to the point.
struct PlacedLabel {
    Box box;
    glm::ivec2 side;
    bool leader;
};

/// What is there already: labels lie inside `area`, off the marks and what is taken, and, if it can be had, off the lines.
struct Surroundings {
    Box area;
    std::vector<glm::dvec2> marks; // of all points, labelled or not
    std::vector<Box> taken = {};
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines = {};
};

/// Puts every label on the best free place near its point, one after another; no label lies on another or on the line that
/// leads to it. Nothing for a point that has no free place.
std::vector<std::optional<PlacedLabel>> placeLabels(const std::vector<LabelledPoint>& points, const Surroundings& around);

/// Puts the labels of points that share a column one below another at the left side of `area`, in the order of the points'
/// heights and each as near to its own as the others allow (least squares of the distances). They are a line apart, or
/// nearer where `area` has less room.
std::vector<PlacedLabel> placeInColumn(const std::vector<LabelledPoint>& points, const Box& area);

} // namespace shadowbench::report
