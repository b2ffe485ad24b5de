#include "harness/report/labels.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace shadowbench::report {
namespace {

constexpr double pointRadius = 7; // pixels kept free around a point

/// Displacements of a label's box from its point, as unit offsets: right, left, above, below, then the corners.
constexpr glm::ivec2 directions[] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}};

Box candidate(glm::dvec2 point, glm::dvec2 size, glm::ivec2 direction, double distance) {
    const glm::dvec2 centre = point + glm::dvec2(direction) * (0.5 * size + distance);
    return {centre - 0.5 * size, centre + 0.5 * size};
}

Box around(glm::dvec2 point) { return {point - pointRadius, point + pointRadius}; }

} // namespace

bool Box::overlaps(const Box& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
}

bool Box::contains(const Box& other) const {
    return low.x <= other.low.x && low.y <= other.low.y && high.x >= other.high.x && high.y >= other.high.y;
}

bool Box::meets(glm::dvec2 a, glm::dvec2 b) const {
    const glm::dvec2 first = glm::min(a, b);
    const glm::dvec2 last = glm::max(a, b);
    return first.x <= high.x && last.x >= low.x && first.y <= high.y && last.y >= low.y;
}

std::vector<PlacedLabel> placeLabels(const std::vector<LabelledPoint>& points, const Box& area,
                                     const std::vector<std::pair<glm::dvec2, glm::dvec2>>& lines, glm::dvec2 letter) {
    std::vector<PlacedLabel> placed;
    const auto penalty = [&](const Box& box) {
        double sum = area.contains(box) ? 0 : 1e5;
        for (const PlacedLabel& other : placed) sum += box.overlaps(other.box) ? 1e4 : 0;
        for (const LabelledPoint& other : points) sum += box.overlaps(around(other.at)) ? 1e4 : 0;
        for (const auto& [a, b] : lines) sum += box.meets(a, b) ? 40 : 0;
        return sum;
    };
    for (const LabelledPoint& point : points) {
        const glm::dvec2 size(letter.x * static_cast<double>(point.text.size()), letter.y);
        double least = std::numeric_limits<double>::infinity();
        PlacedLabel best{};
        for (const double distance : {9.0, 18.0, 28.0, 40.0, 55.0, 75.0, 100.0}) {
            for (const glm::ivec2 direction : directions) {
                const Box box = candidate(point.at, size, direction, distance);
                const double worth = penalty(box) + distance;
                if (worth >= least) continue;
                least = worth;
                best = {box, distance > 9.0};
            }
        }
        placed.push_back(best);
    }
    return placed;
}

} // namespace shadowbench::report
