#include "groundtruth/cgal/area/area_sweep.h"

#include "groundtruth/cgal/area/area_slabs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::area {
namespace {

/// `change` is that of an edge that runs downwards, which has more to its left.
void addEdge(const glm::dvec2& from, const glm::dvec2& to, const Change& change, std::vector<UpwardEdge>& edges) {
    if (to.y < from.y) edges.push_back({to, from, change});
    if (to.y > from.y) edges.push_back({from, to, {-change.covers, -change.inner, -change.outer}});
}

void addPolygon(const LightPolygon& polygon, const Change& change, std::vector<UpwardEdge>& edges) {
    for (std::size_t i = 0; i < polygon.size(); ++i) addEdge(polygon[i], polygon[(i + 1) % polygon.size()], change, edges);
}

/// The gaps between edges at half the height of the row count.
void addRow(const Row& row, LightAreas& areas) {
    LightAreas lengths{};
    Change now;
    double left = 0;
    for (const UpwardEdge* edge : row.edges) {
        const double gap = edge->place - left;
        if (now.inner > 0) (now.covers > 0 ? lengths.innerHidden : lengths.innerVisible) += gap;
        if (now.outer > 0) (now.covers > 0 ? lengths.outerHidden : lengths.outerVisible) += gap;
        now.covers += edge->change.covers;
        now.inner += edge->change.inner;
        now.outer += edge->change.outer;
        left = edge->place;
    }
    const double height = (row.to - row.from) * (row.top - row.bottom);
    areas.innerVisible += height * lengths.innerVisible;
    areas.innerHidden += height * lengths.innerHidden;
    areas.outerVisible += height * lengths.outerVisible;
    areas.outerHidden += height * lengths.outerHidden;
}

/// Edges meet in the same rows as the true ones, each end moved by its error e per coordinate at most: an edge sweeps at
/// most (length + 3 e) · 3 e.
double sweptBy(const CoverEdge& edge) { return 3 * edge.error * (glm::distance(edge.from, edge.to) + 3 * edge.error); }

/// In every row that an edge crosses its place is rounded by some units, and so is the sum over the gaps; each row's height
/// by one, the running sums by one.
double errorBound(const std::vector<CoverEdge>& edges, const LightShape& shape, std::size_t rows) {
    double error = 0;
    for (const CoverEdge& edge : edges) {
        error += sweptBy(edge);
        error += 16 * unit * std::abs(edge.to.y - edge.from.y);
    }
    const double shapeEdges = shape.area < 1 ? 4 : 2; // that a row crosses
    return error + unit * (16 * shapeEdges + 8 * static_cast<double>(rows));
}

} // namespace

std::vector<UpwardEdge> upwardEdges(const std::vector<CoverEdge>& edges, const LightShape& shape) {
    std::vector<UpwardEdge> all;
    all.reserve(edges.size() + shape.inner.size() + shape.outer.size());
    for (const CoverEdge& edge : edges) addEdge(edge.from, edge.to, {edge.covers, 0, 0}, all);
    addPolygon(shape.inner, {0, 1, 0}, all);
    addPolygon(shape.outer, {0, 0, 1}, all);
    return all;
}

SweptAreas sweepAreas(const std::vector<CoverEdge>& edges, const LightShape& shape) {
    LightAreas areas{};
    std::size_t rows = 0;
    Sweep(upwardEdges(edges, shape)).visitRows([&](const Row& row) {
        addRow(row, areas);
        ++rows;
    });
    double edgeError = 0;
    for (const CoverEdge& edge : edges) edgeError += sweptBy(edge);
    return {areas, errorBound(edges, shape, rows), edgeError};
}

VisibleLength visibleLength(std::vector<CoverInterval> hidden) {
    std::ranges::sort(hidden, {}, &CoverInterval::from);
    VisibleLength result{};
    double reached = -0.5;
    for (const CoverInterval& part : hidden) {
        if (part.from > reached) result.visible += part.from - reached;
        reached = std::max(reached, part.to);
        result.error += 2 * part.error + 4 * unit;
        result.edgeError += 2 * part.error;
    }
    if (reached < 0.5) result.visible += 0.5 - reached;
    return result;
}

} // namespace shadowbench::groundtruth::area
