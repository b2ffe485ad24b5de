#include "groundtruth/cgal/area/area_points.h"

#include "groundtruth/cgal/area/area_view.h"

#include <algorithm>

namespace shadowbench::groundtruth::area {
namespace {

struct PlacedPoint {
    glm::dvec2 at;
    std::uint32_t set;
};

/// The light whose points are their own light coordinates.
Light unitLight(LightKind kind) { return {kind, {0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}; }

} // namespace

LightPoints::LightPoints(LightKind kind, const std::vector<std::vector<glm::dvec2>>& sets) {
    const Light light = unitLight(kind);
    std::vector<PlacedPoint> points;
    for (std::size_t set = 0; set < sets.size(); ++set) {
        sizes_.push_back(static_cast<int>(sets[set].size()));
        for (const glm::dvec2& st : sets[set])
            points.push_back({glm::dvec2(light.sample(st)), static_cast<std::uint32_t>(set)});
    }
    std::ranges::stable_sort(points, {}, [](const PlacedPoint& p) { return p.at.y; });
    for (const PlacedPoint& point : points) {
        x_.push_back(point.at.x);
        y_.push_back(point.at.y);
        set_.push_back(point.set);
    }
}

std::vector<int> LightPoints::visible(const std::vector<CoverEdge>& edges) const {
    std::vector<int> covers(x_.size(), 0);
    for (const CoverEdge& edge : edges) {
        if (edge.from.y == edge.to.y) continue;
        const bool upward = edge.from.y < edge.to.y;
        const glm::dvec2 low = upward ? edge.from : edge.to, high = upward ? edge.to : edge.from;
        const int change = upward ? -edge.covers : edge.covers; // from the left of the edge to its right
        const double slope = (high.x - low.x) / (high.y - low.y);
        const auto first = static_cast<std::size_t>(std::ranges::lower_bound(y_, low.y) - y_.begin());
        const auto last = static_cast<std::size_t>(std::ranges::lower_bound(y_, high.y) - y_.begin());
        for (std::size_t i = first; i < last; ++i) covers[i] += low.x + slope * (y_[i] - low.y) < x_[i] ? change : 0;
    }
    std::vector<int> counts(sizes_.size(), 0);
    for (std::size_t i = 0; i < covers.size(); ++i) counts[set_[i]] += covers[i] <= 0 ? 1 : 0;
    return counts;
}

std::vector<int> LightPoints::visible(const std::vector<CoverInterval>& hidden) const {
    std::vector<int> counts(sizes_.size(), 0);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const auto hides = [&](const CoverInterval& part) { return part.from <= x_[i] && x_[i] < part.to; };
        counts[set_[i]] += std::ranges::any_of(hidden, hides) ? 0 : 1;
    }
    return counts;
}

} // namespace shadowbench::groundtruth::area
