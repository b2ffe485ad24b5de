// The plane is cut into unit cells between four pixel centres. In a cell the edges are split where they cross; the winding
// number on both sides of a piece is that of a corner plus the edges crossed on the way.
#include "groundtruth/cgal/edge_distance.h"

#include "groundtruth/cgal/pixel_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

constexpr double sideStep = 1e-7; // pixels from a piece at which its two sides are tested

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 d = b - a;
    const double length2 = glm::dot(d, d);
    const double share = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
    return glm::length(a + share * d - p);
}

/// Share of `e` at which it crosses `other`, if it does.
std::optional<double> crossingShare(const PixelEdge& e, const PixelEdge& other) {
    const glm::dvec2 d = e.to - e.from, o = other.to - other.from, between = other.from - e.from;
    const double area = cross(d, o);
    if (area == 0) return std::nullopt;
    const double along = cross(between, d) / area;
    if (along < 0 || along > 1) return std::nullopt;
    return cross(between, o) / area;
}

/// Change of the winding number on the way from `start` to `end`. An edge that runs down adds on the way right.
int windingChange(const glm::dvec2& start, const glm::dvec2& end, std::span<const PixelEdge* const> edges) {
    const glm::dvec2 way = end - start;
    int change = 0;
    for (const PixelEdge* e : edges) {
        const bool fromLeft = cross(way, e->from - start) < 0, toLeft = cross(way, e->to - start) < 0;
        if (fromLeft == toLeft) continue;
        const glm::dvec2 d = e->to - e->from;
        const bool startSide = cross(d, start - e->from) < 0, endSide = cross(d, end - e->from) < 0;
        if (startSide == endSide) continue;
        change += fromLeft ? e->covers : -e->covers;
    }
    return change;
}

/// A point whose winding number is known.
struct Anchor {
    glm::dvec2 point;
    int winding;
};

struct Square {
    glm::dvec2 low;
    double side;
};

/// From where to where an edge lies in a square; last < first if nowhere.
std::pair<double, double> sharesIn(const PixelEdge& e, const Square& square) {
    double first = 0, last = 1;
    for (int axis = 0; axis < 2; ++axis) {
        const double a = e.from[axis] - square.low[axis], d = e.to[axis] - e.from[axis];
        if (d == 0) {
            if (a < 0 || a > square.side) return {1, 0};
            continue;
        }
        first = std::max(first, std::min(-a / d, (square.side - a) / d));
        last = std::min(last, std::max(-a / d, (square.side - a) / d));
    }
    return {first, last};
}

/// The edges that matter to points in the square and next to it.
std::vector<const PixelEdge*> edgesIn(const Square& square, std::span<const PixelEdge* const> edges) {
    const double margin = 10 * sideStep;
    const Square wider{square.low - margin, square.side + 2 * margin};
    std::vector<const PixelEdge*> result;
    for (const PixelEdge* edge : edges)
        if (const auto [first, last] = sharesIn(*edge, wider); first <= last) result.push_back(edge);
    return result;
}

class EdgeDistance {
public:
    EdgeDistance(const std::vector<PixelEdge>& edges, const Image<int>& winding, const Image<std::uint8_t>& uncertain,
                 const Image<std::uint8_t>& members, Image<float>& distance)
        : edges_(edges), winding_(winding), uncertain_(uncertain), members_(members), distance_(distance),
          cells_(winding.width() - 1, winding.height() - 1) {
        for (std::uint32_t i = 0; i < edges_.size(); ++i) enter(i);
    }

    void run() {
        for (int y = 0; y < cells_.height(); ++y)
            for (int x = 0; x < cells_.width(); ++x)
                if (!cells_(x, y).empty()) visitCell(x, y);
    }

private:
    static glm::dvec2 centre(int x, int y) { return {x - scanMargin + 0.5, y - scanMargin + 0.5}; }

    /// Does one of the cell's corners see the receiver?
    [[nodiscard]] bool seen(int x, int y) const {
        for (int i = 0; i < 4; ++i) {
            const int px = x + i % 2 - scanMargin, py = y + i / 2 - scanMargin;
            if (members_.contains(px, py) && members_(px, py)) return true;
        }
        return false;
    }

    /// Lists the edge in the cells it may pass through, row by row.
    void enter(std::uint32_t index) {
        const PixelEdge& e = edges_[index];
        const glm::dvec2 offset(scanMargin - 0.5);
        glm::dvec2 a = e.from + offset, b = e.to + offset;
        if (a.y > b.y) std::swap(a, b);
        const int top = std::max(0, static_cast<int>(std::floor(a.y)));
        const int bottom = std::min(cells_.height() - 1, static_cast<int>(std::floor(b.y)));
        for (int y = top; y <= bottom; ++y) {
            const double first = b.y > a.y ? std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : 0;
            const double last = b.y > a.y ? std::clamp((y + 1 - a.y) / (b.y - a.y), 0.0, 1.0) : 1;
            const double x0 = a.x + first * (b.x - a.x), x1 = a.x + last * (b.x - a.x);
            const int left = std::max(0, static_cast<int>(std::floor(std::min(x0, x1) - 1e-9)));
            const int right = std::min(cells_.width() - 1, static_cast<int>(std::floor(std::max(x0, x1) + 1e-9)));
            for (int x = left; x <= right; ++x)
                if (seen(x, y)) cells_(x, y).push_back(index);
        }
    }

    void visitCell(int x, int y) {
        const std::optional<Anchor> corner = anchorOf(x, y);
        if (!corner) return;
        std::vector<const PixelEdge*> here;
        for (const std::uint32_t index : cells_(x, y)) here.push_back(&edges_[index]);
        visitSquare({centre(x, y), 1}, *corner, here);
    }

    /// A corner of the cell, if possible one that no edge passes through.
    [[nodiscard]] std::optional<Anchor> anchorOf(int x, int y) const {
        std::optional<Anchor> anchor;
        for (int i = 0; i < 4; ++i) {
            const int column = x + i % 2, row = y + i / 2;
            if (winding_(column, row) < 0) continue;
            const bool certain = uncertain_(column, row) == 0;
            if (certain || !anchor) anchor = Anchor{centre(column, row), winding_(column, row)};
            if (certain) break;
        }
        return anchor;
    }

    /// `anchor` lies in the square or on its border.
    void visitSquare(const Square& square, const Anchor& anchor, std::span<const PixelEdge* const> here) {
        int most = 0;
        for (const PixelEdge* edge : here) most += std::abs(edge->covers);
        if (anchor.winding > most) return; // shadowed throughout

        constexpr std::size_t fewEdges = 16;
        constexpr double smallest = 1.0 / 128;
        if (here.size() <= fewEdges || square.side <= smallest) {
            for (const PixelEdge* edge : here) visitEdge(*edge, square, anchor, here);
            return;
        }
        const double half = 0.5 * square.side;
        for (int i = 0; i < 4; ++i) {
            const Square quarter{square.low + half * glm::dvec2(i % 2, i / 2), half};
            const glm::dvec2 inside = quarter.low + half * glm::dvec2(0.381, 0.618); // unlikely to lie on an edge
            const Anchor next{inside, anchor.winding + windingChange(anchor.point, inside, here)};
            visitSquare(quarter, next, edgesIn(quarter, here));
        }
    }

    void visitEdge(const PixelEdge& e, const Square& square, const Anchor& anchor, std::span<const PixelEdge* const> here) {
        const auto [first, last] = sharesIn(e, square);
        if (first >= last) return;
        std::vector<double> cuts{first, last};
        for (const PixelEdge* other : here)
            if (const std::optional<double> share = crossingShare(e, *other); share && *share > first && *share < last)
                cuts.push_back(*share);
        std::ranges::sort(cuts);
        const glm::dvec2 d = e.to - e.from;
        const glm::dvec2 aside = sideStep / glm::length(d) * glm::dvec2(-d.y, d.x);
        for (std::size_t i = 1; i < cuts.size(); ++i) {
            const glm::dvec2 middle = e.from + 0.5 * (cuts[i - 1] + cuts[i]) * d;
            const bool left = anchor.winding + windingChange(anchor.point, middle + aside, here) > 0;
            const bool right = anchor.winding + windingChange(anchor.point, middle - aside, here) > 0;
            if (left != right) spread(e.from + cuts[i - 1] * d, e.from + cuts[i] * d);
        }
    }

    void spread(const glm::dvec2& a, const glm::dvec2& b) {
        const glm::ivec2 low(glm::floor(glm::min(a, b) - 0.5 - edgeReach)),
            high(glm::ceil(glm::max(a, b) - 0.5 + edgeReach));
        for (int y = std::max(0, low.y); y <= std::min(members_.height() - 1, high.y); ++y) {
            for (int x = std::max(0, low.x); x <= std::min(members_.width() - 1, high.x); ++x) {
                if (!members_(x, y)) continue;
                const double d = distanceToSegment({x + 0.5, y + 0.5}, a, b);
                if (d <= edgeReach) distance_(x, y) = std::min(distance_(x, y), static_cast<float>(d));
            }
        }
    }

    const std::vector<PixelEdge>& edges_;
    const Image<int>& winding_;
    const Image<std::uint8_t>& uncertain_;
    const Image<std::uint8_t>& members_;
    Image<float>& distance_;
    Image<std::vector<std::uint32_t>> cells_;
};

} // namespace

void lowerToEdgeDistance(const std::vector<PixelEdge>& edges, const Image<int>& winding,
                         const Image<std::uint8_t>& uncertain, const Image<std::uint8_t>& members, Image<float>& distance) {
    EdgeDistance(edges, winding, uncertain, members, distance).run();
}

} // namespace shadowbench::groundtruth
