#include "groundtruth/cgal/hard/plane_winding.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/cgal/geometry/primary.h"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <string>

namespace shadowbench::groundtruth::hard {
namespace {

[[noreturn]] void inconsistent(int row) {
    throw InternalError("Winding numbers disagree in image row " + std::to_string(row - scanMargin) +
                        ": the silhouettes of this scene are inconsistent; please report it.");
}

/// May the edge meet the rectangle between two centres (pixel + scanMargin)?
bool mayMeet(const PixelEdge& edge, glm::ivec2 low, glm::ivec2 high) {
    const double toCentre = 0.5 - scanMargin, error = 2 * edge.error;
    return glm::all(glm::greaterThanEqual(glm::max(edge.from, edge.to) + error, glm::dvec2(low) + toCentre)) &&
           glm::all(glm::lessThanEqual(glm::min(edge.from, edge.to) - error, glm::dvec2(high) + toCentre));
}

int onlyNumber(const WindingAround::Range& range, int row) {
    if (range.lowest != range.highest) inconsistent(row);
    return range.lowest;
}

} // namespace

PlaneWinding::PlaneWinding(const PlaneView& view, const Occluders& occluders, const Casters& casters,
                           const std::vector<PixelEdge>& edges)
    : view_(view), occluders_(occluders), casters_(casters), edges_(edges), winding_(scan(edges, view.size)),
      wanted_(winding_.change.width(), winding_.change.height()), shift_(height()), uncertainEdges_(height()) {
    inParallel(height(), occluders_.threads(), [&](int row) {
        findWanted(row);
        sumRow(row);
    });
    linkRows();
    for (int row = 1; row < height(); ++row) checkRow(row);
    listUncertainEdges();
}

void PlaneWinding::findWanted(int row) {
    const auto member = [&](int x, int y) {
        return view_.members.contains(x - scanMargin, y - scanMargin) && view_.members(x - scanMargin, y - scanMargin) != 0;
    };
    for (int x = 0; x < width(); ++x) {
        bool near = member(x, row);
        wanted_(x, row) = near;
        for (int i = 0; i < 9 && !near; ++i) near = member(x + i % 3 - 1, row + i / 3 - 1);
        if (near && !wanted_(x, row)) wanted_(x, row) = onPlane(x, row);
    }
}

/// Does the pixel look at the plane within reach? Pixels of the receiver do. The pixels that do are convex in the image.
bool PlaneWinding::onPlane(int x, int row) const {
    const Ray ray = centreRay(x, row);
    const glm::dvec3 normal = glm::cross(view_.plane[1] - view_.plane[0], view_.plane[2] - view_.plane[0]);
    const double depth = glm::dot(normal, view_.plane[0] - ray.origin) / glm::dot(normal, ray.direction);
    return depth > 0.5 * view_.camera.near && depth < view_.camera.far;
}

void PlaneWinding::sumRow(int row) {
    int sum = 0;
    for (int x = 0; x < width(); ++x) winding_.change(x, row) = sum += winding_.change(x, row);
}

std::optional<int> PlaneWinding::firstCertain(int row) const {
    for (int x = 0; x < width(); ++x)
        if (isCertain(x, row)) return x;
    return std::nullopt;
}

/// A column in which the step from the row above is certain.
std::optional<int> PlaneWinding::linkColumn(int row) const {
    for (int x = 0; x < width(); ++x)
        if (isCertain(x, row) && isCertain(x, row - 1)) return x;
    return std::nullopt;
}

/// The first number is exact, and so is the way to a row that no certain step leads to. The last number is checked.
void PlaneWinding::linkRows() {
    std::optional<glm::ivec2> last; // that is certain
    for (int row = 0; row < height(); ++row) {
        const std::optional<int> first = firstCertain(row);
        if (!first) continue;
        const bool follows = last && last->y == row - 1;
        if (const std::optional<int> link = follows ? linkColumn(row) : std::nullopt)
            shift_[row] = *shift_[row - 1] + winding_.change(*link, row - 1) + winding_.changeDown(*link, row) -
                          winding_.change(*link, row);
        else
            shift_[row] =
                (last ? exactNumber({*first, row}, *last) : exactNumber({*first, row})) - winding_.change(*first, row);
        last = glm::ivec2(*first, row);
    }
    if (!last) return;
    for (int x = last->x; x < width(); ++x)
        if (isCertain(x, last->y)) last->x = x;
    if (exactNumber(*last) != number(last->x, last->y)) inconsistent(last->y);
}

/// All certain steps down to a row must lead to the same numbers as the steps along it.
void PlaneWinding::checkRow(int row) const {
    if (!shift_[row] || !shift_[row - 1]) return;
    for (int x = 0; x < width(); ++x) {
        if (!isCertain(x, row) || !isCertain(x, row - 1)) continue;
        const int above = *shift_[row - 1] + winding_.change(x, row - 1), here = *shift_[row] + winding_.change(x, row);
        if (above < 0 || here < 0 || above + winding_.changeDown(x, row) != here) inconsistent(row);
    }
}

int PlaneWinding::number(int x, int row) const {
    return shift_[row] && wanted_(x, row) ? std::max(*shift_[row] + winding_.change(x, row), unknown) : unknown;
}

void PlaneWinding::listUncertainEdges() {
    std::vector<std::uint8_t> needed(height(), 0);
    for (int y = 0; y < view_.size.y; ++y)
        for (int x = 0; x < view_.size.x; ++x)
            if (view_.members(x, y) && winding_.uncertain(x + scanMargin, y + scanMargin)) needed[y + scanMargin] = 1;
    if (std::ranges::find(needed, 1) == needed.end()) return;
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        const auto [top, bottom] = rowsNear(edges_[i], view_.size);
        for (int row = top; row <= bottom; ++row)
            if (needed[row]) uncertainEdges_[row].push_back(i);
    }
}

Ray PlaneWinding::centreRay(int x, int row) const {
    return pixelRay(view_.camera, x - scanMargin, row - scanMargin, view_.size);
}

SpatialEdge PlaneWinding::edge(std::uint32_t index) const {
    const CastEdge cast = casters_.edge(index);
    return spatialEdge(cast.instance, cast.edge);
}

void PlaneWinding::addEdges(WindingAround& around, std::size_t begin, std::size_t end) const {
    casters_.forEachEdge(begin, end,
                         [&](std::size_t, const CastEdge& cast) { around.add(spatialEdge(cast.instance, cast.edge)); });
}

int PlaneWinding::exactNumber(glm::ivec2 at) const {
    std::atomic<int> sum = 0;
    inParallelParts(casters_.edges(), occluders_.threads(), [&](std::size_t begin, std::size_t end) {
        const ReceiverPoint point(centreRay(at.x, at.y), view_.plane);
        WindingAround around(point, view_.plane, occluders_.light());
        addEdges(around, begin, end);
        sum += onlyNumber(around.range(), at.y);
    });
    return sum;
}

/// From that of `start`, of a row that is known.
int PlaneWinding::exactNumber(glm::ivec2 at, glm::ivec2 start) const {
    const ReceiverPoint point(centreRay(at.x, at.y), view_.plane), from(centreRay(start.x, start.y), view_.plane);
    WindingAround around(point, from, view_.plane, occluders_.light());
    for (const PixelEdge& near : edges_)
        if (mayMeet(near, glm::min(at, start), glm::max(at, start))) around.add(edge(near.source));
    return onlyNumber(around.range(number(start.x, start.y)), at.y);
}

WindingAround::Range PlaneWinding::at(int x, int y) const {
    const int column = x + scanMargin, row = y + scanMargin;
    if (winding_.uncertain(column, row)) return exactAround(column, row);
    return {number(column, row), number(column, row)};
}

WindingAround::Range PlaneWinding::exactAround(int x, int row) const {
    const ReceiverPoint point(centreRay(x, row), view_.plane);
    const std::vector<TriangleName> grounded = groundedAt(point);
    const std::optional<int> start = grounded.empty() ? nearestCertain(x, row) : std::nullopt;
    if (start) {
        const ReceiverPoint from(centreRay(*start, row), view_.plane);
        WindingAround around(point, from, view_.plane, occluders_.light());
        const glm::ivec2 low(std::min(x, *start), row), high(std::max(x, *start), row);
        for (const std::uint32_t i : uncertainEdges_[row])
            if (mayMeet(edges_[i], low, high)) around.add(edge(edges_[i].source));
        return around.range(number(*start, row));
    }
    WindingAround around(point, view_.plane, occluders_.light());
    addEdges(around, 0, casters_.edges());
    for (const TriangleName& name : grounded)
        for (SpatialEdge border :
             borderOf(occluders_.scene().instances()[name.instance], name.triangle, occluders_.light(), view_.plane)) {
            border.covers = -border.covers;
            around.add(border);
        }
    return around.range();
}

/// Occluding triangles whose plane contains the point: it lies on them, they do not cover it.
std::vector<TriangleName> PlaneWinding::groundedAt(const ReceiverPoint& point) const {
    std::vector<TriangleName> result;
    for (const TriangleName& name : casters_.grounded()) {
        const Triangle t = occluders_.scene().triangle(name);
        const glm::dvec3 low = glm::min(t[0], glm::min(t[1], t[2])), high = glm::max(t[0], glm::max(t[1], t[2]));
        const bool apart = glm::any(glm::greaterThan(low, point.high())) || glm::any(glm::lessThan(high, point.low()));
        if (!apart && inPlane(t, point)) result.push_back(name);
    }
    return result;
}

/// In the same row.
std::optional<int> PlaneWinding::nearestCertain(int x, int row) const {
    if (!shift_[row]) return std::nullopt;
    for (int distance = 1; distance < width(); ++distance)
        for (const int other : {x - distance, x + distance})
            if (wanted_.contains(other, row) && isCertain(other, row)) return other;
    return std::nullopt;
}

} // namespace shadowbench::groundtruth::hard
