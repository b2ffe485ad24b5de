#include "report/labels.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace shadowbench::report {
namespace {

constexpr double pointRadius = 7; // pixels kept free around a point
constexpr double nearest = 10;    // pixels between a point and its label where there is room

/// Displacements of a label's box from its point, as unit offsets: right, left, above, below, then the corners.
constexpr glm::ivec2 directions[] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}};

Box candidate(glm::dvec2 point, glm::dvec2 size, glm::ivec2 direction, double distance) {
    const glm::dvec2 centre = point + glm::dvec2(direction) * (0.5 * size + distance);
    return {centre - 0.5 * size, centre + 0.5 * size};
}

Box around(glm::dvec2 point) { return {point - pointRadius, point + pointRadius}; }

/// Heights in the order of the wanted ones, `step` apart at least, from `low` to `high`: what is left of a wanted height
/// when the steps before it are taken away must not fall, so neighbours that would fall take their mean (isotonic
/// regression).
std::vector<double> spread(const std::vector<double>& wanted, double step, double low, double high) {
    struct Level {
        double sum;
        int count;
        [[nodiscard]] double mean() const { return sum / count; }
    };
    std::vector<Level> levels;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        Level last{wanted[i] - step * static_cast<double>(i), 1};
        for (; !levels.empty() && levels.back().mean() > last.mean(); levels.pop_back())
            last = {last.sum + levels.back().sum, last.count + levels.back().count};
        levels.push_back(last);
    }
    const double highest = high - step * (static_cast<double>(wanted.size()) - 1);
    std::vector<double> result;
    for (const Level& level : levels)
        for (int i = 0; i < level.count; ++i)
            result.push_back(std::clamp(level.mean(), low, std::max(low, highest)) +
                             step * static_cast<double>(result.size()));
    return result;
}

} // namespace

glm::dvec2 Box::closest(glm::dvec2 point) const { return glm::clamp(point, low, high); }

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
    const auto penalty = [&](const Box& box, glm::dvec2 point) {
        double sum = area.contains(box) ? 0 : 1e5;
        for (std::size_t i = 0; i < placed.size(); ++i) {
            if (box.overlaps(placed[i].box)) sum += 1e4;
            const bool crossed = box.meets(points[i].at, placed[i].box.closest(points[i].at)) ||
                                 placed[i].box.meets(point, box.closest(point)); // by the line that leads to a label
            if (crossed) sum += 30;
        }
        for (const LabelledPoint& other : points) sum += box.overlaps(around(other.at)) ? 1e4 : 0;
        for (const auto& [a, b] : lines) sum += box.meets(a, b) ? 40 : 0;
        return sum;
    };
    for (const LabelledPoint& point : points) {
        const glm::dvec2 size(letter.x * static_cast<double>(point.text.size()), letter.y);
        double least = std::numeric_limits<double>::infinity();
        PlacedLabel best{};
        for (const double distance : {nearest, 18.0, 28.0, 40.0, 55.0, 75.0, 100.0}) {
            for (const glm::ivec2 direction : directions) {
                const Box box = candidate(point.at, size, direction, distance);
                const double worth = penalty(box, point.at) + distance;
                if (worth >= least) continue;
                least = worth;
                best = {box, direction, distance > nearest};
            }
        }
        placed.push_back(best);
    }
    return placed;
}

std::vector<PlacedLabel> placeInColumn(const std::vector<LabelledPoint>& points, const Box& area, glm::dvec2 letter) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return points[i].at.y; });
    std::vector<double> wanted;
    wanted.reserve(order.size());
    for (const std::size_t i : order) wanted.push_back(points[i].at.y);
    const double step =
        std::min(letter.y, (area.high.y - area.low.y) / static_cast<double>(std::max<std::size_t>(1, order.size())));
    const std::vector<double> heights = spread(wanted, step, area.low.y + 0.5 * step, area.high.y - 0.5 * step);
    std::vector<PlacedLabel> placed(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const LabelledPoint& point = points[order[k]];
        const double wide = letter.x * static_cast<double>(point.text.size());
        placed[order[k]] = {
            {{area.low.x, heights[k] - 0.5 * step}, {area.low.x + wide, heights[k] + 0.5 * step}}, {1, 0}, true};
    }
    return placed;
}

} // namespace shadowbench::report
