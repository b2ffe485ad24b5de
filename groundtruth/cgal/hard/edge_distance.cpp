// The plane is cut into unit cells between four pixel centres. In a cell the edges are split where they cross; the winding
// number on both sides of a piece is that of a corner plus the edges crossed on the way.
#include "groundtruth/cgal/hard/edge_distance.h"

#include "base/parallel.h"
#include "groundtruth/cgal/hard/pixel_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr double sideStep = 1e-7; // pixels from a piece at which its two sides are tested

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double squaredDistance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 d = b - a;
    const double length2 = glm::dot(d, d);
    const double share = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec2 offset = a + share * d - p;
    return glm::dot(offset, offset);
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

/// A piece of an edge that bounds the union of shadows, by shares of the edge.
struct Piece {
    std::uint32_t edge;
    double first, last;
};

struct Segment {
    glm::dvec2 from, to;
};

/// Finds the pieces cell by cell.
class VisibleBoundary {
public:
    VisibleBoundary(const std::vector<PixelEdge>& edges, const PlaneWinding& winding, const Image<std::uint8_t>& members)
        : edges_(edges), winding_(winding), members_(members), width_(winding.width() - 1), height_(winding.height() - 1),
          first_(static_cast<std::size_t>(width_) * height_ + 1, 0) {
        listEdges();
    }

    [[nodiscard]] int rows() const { return height_; }

    /// The pieces in one row of cells.
    [[nodiscard]] std::vector<Piece> piecesIn(int row) const {
        std::vector<Piece> pieces;
        for (int x = 0; x < width_; ++x)
            if (!edgesOf(x, row).empty()) visitCell(x, row, pieces);
        return pieces;
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

    [[nodiscard]] std::uint32_t indexOf(const PixelEdge& edge) const {
        return static_cast<std::uint32_t>(&edge - edges_.data());
    }

    [[nodiscard]] std::size_t cell(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

    [[nodiscard]] std::span<const std::uint32_t> edgesOf(int x, int y) const {
        return {listed_.data() + first_[cell(x, y)], listed_.data() + first_[cell(x, y) + 1]};
    }

    /// Lists every edge in the seen cells it may pass through, by a counting sort.
    void listEdges() {
        std::vector<std::uint32_t> next(first_.size() - 1, 0);
        for (const PixelEdge& edge : edges_) forEachCell(edge, [&](std::size_t c) { ++next[c]; });
        for (std::size_t c = 0; c < next.size(); ++c) {
            first_[c + 1] = first_[c] + next[c];
            next[c] = first_[c];
        }
        listed_.resize(first_.back());
        for (std::uint32_t i = 0; i < edges_.size(); ++i)
            forEachCell(edges_[i], [&](std::size_t c) { listed_[next[c]++] = i; });
    }

    template <typename Visit>
    void forEachCell(const PixelEdge& e, const Visit& visit) const {
        if (e.covers == 0) return;
        const glm::dvec2 offset(scanMargin - 0.5);
        glm::dvec2 a = e.from + offset, b = e.to + offset;
        if (a.y > b.y) std::swap(a, b);
        const int top = std::max(0, static_cast<int>(std::floor(a.y)));
        const int bottom = std::min(height_ - 1, static_cast<int>(std::floor(b.y)));
        for (int y = top; y <= bottom; ++y) {
            const double first = b.y > a.y ? std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : 0;
            const double last = b.y > a.y ? std::clamp((y + 1 - a.y) / (b.y - a.y), 0.0, 1.0) : 1;
            const double x0 = a.x + first * (b.x - a.x), x1 = a.x + last * (b.x - a.x);
            const int left = std::max(0, static_cast<int>(std::floor(std::min(x0, x1) - 1e-9)));
            const int right = std::min(width_ - 1, static_cast<int>(std::floor(std::max(x0, x1) + 1e-9)));
            for (int x = left; x <= right; ++x)
                if (seen(x, y)) visit(cell(x, y));
        }
    }

    void visitCell(int x, int y, std::vector<Piece>& pieces) const {
        const std::optional<Anchor> corner = anchorOf(x, y);
        if (!corner) return;
        std::vector<const PixelEdge*> here;
        for (const std::uint32_t index : edgesOf(x, y)) here.push_back(&edges_[index]);
        visitSquare({centre(x, y), 1}, *corner, here, pieces);
    }

    /// A corner of the cell, if possible one that no edge passes through.
    [[nodiscard]] std::optional<Anchor> anchorOf(int x, int y) const {
        std::optional<Anchor> anchor;
        for (int i = 0; i < 4; ++i) {
            const int column = x + i % 2, row = y + i / 2;
            const int number = winding_.number(column, row);
            if (number == PlaneWinding::unknown) continue;
            const bool certain = winding_.isCertain(column, row);
            if (certain || !anchor) anchor = Anchor{centre(column, row), number};
            if (certain) break;
        }
        return anchor;
    }

    /// `anchor` lies in the square or on its border.
    void visitSquare(const Square& square, const Anchor& anchor, std::span<const PixelEdge* const> here,
                     std::vector<Piece>& pieces) const {
        int most = 0;
        for (const PixelEdge* edge : here) most += std::abs(edge->covers);
        if (anchor.winding > most) return; // shadowed throughout

        constexpr std::size_t fewEdges = 16;
        constexpr double smallest = 1.0 / 128;
        if (here.size() <= fewEdges || square.side <= smallest) {
            for (const PixelEdge* edge : here) visitEdge(*edge, square, anchor, here, pieces);
            return;
        }
        const double half = 0.5 * square.side;
        for (int i = 0; i < 4; ++i) {
            const Square quarter{square.low + half * glm::dvec2(i % 2, i / 2), half};
            const glm::dvec2 inside = quarter.low + half * glm::dvec2(0.381, 0.618); // unlikely to lie on an edge
            const Anchor next{inside, anchor.winding + windingChange(anchor.point, inside, here)};
            visitSquare(quarter, next, edgesIn(quarter, here), pieces);
        }
    }

    void visitEdge(const PixelEdge& e, const Square& square, const Anchor& anchor, std::span<const PixelEdge* const> here,
                   std::vector<Piece>& pieces) const {
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
            if (left != right) pieces.push_back({indexOf(e), cuts[i - 1], cuts[i]});
        }
    }

    const std::vector<PixelEdge>& edges_;
    const PlaneWinding& winding_;
    const Image<std::uint8_t>& members_;
    int width_, height_;               // in cells
    std::vector<std::uint32_t> first_; // of the edges listed for a cell
    std::vector<std::uint32_t> listed_;
};

/// Joins what the cells have cut: fewer and longer segments are quicker to measure from.
std::vector<Segment> joined(std::vector<Piece>& pieces, const std::vector<PixelEdge>& edges) {
    std::ranges::sort(pieces, {}, [](const Piece& p) { return std::pair(p.edge, p.first); });
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < pieces.size();) {
        const PixelEdge& edge = edges[pieces[i].edge];
        const glm::dvec2 d = edge.to - edge.from;
        const double gap = 1e-9 / glm::length(d); // pixels; rounding leaves less
        const std::size_t begin = i++;
        double last = pieces[begin].last;
        for (; i < pieces.size() && pieces[i].edge == pieces[begin].edge && pieces[i].first <= last + gap; ++i)
            last = std::max(last, pieces[i].last);
        segments.push_back({edge.from + pieces[begin].first * d, edge.from + last * d});
    }
    return segments;
}

/// Lowers the distances of one row of pixels to that to a segment.
void lowerRow(int y, const Segment& segment, const Image<std::uint8_t>& members, Image<float>& distance) {
    const double low = std::min(segment.from.x, segment.to.x), high = std::max(segment.from.x, segment.to.x);
    const int first = std::max(0, static_cast<int>(std::floor(low - 0.5 - edgeReach)));
    const int last = std::min(members.width() - 1, static_cast<int>(std::ceil(high - 0.5 + edgeReach)));
    constexpr double rounding = 1 + 1e-12;
    for (int x = first; x <= last; ++x) {
        if (!members(x, y)) continue;
        const double known = std::min(static_cast<double>(distance(x, y)), edgeReach);
        const double squared = squaredDistance({x + 0.5, y + 0.5}, segment.from, segment.to);
        if (squared > known * known * rounding) continue;
        const double d = std::sqrt(squared);
        if (d <= edgeReach) distance(x, y) = std::min(distance(x, y), static_cast<float>(d));
    }
}

/// May the segment lie within reach of the centres of rows `first` to `last`?
bool near(const Segment& segment, int first, int last) {
    return last + 0.5 >= std::min(segment.from.y, segment.to.y) - edgeReach &&
           first + 0.5 <= std::max(segment.from.y, segment.to.y) + edgeReach;
}

void lowerBand(int first, int last, const std::vector<Segment>& segments, const Image<std::uint8_t>& members,
               Image<float>& distance) {
    for (const Segment& segment : segments) {
        if (!near(segment, first, last)) continue;
        for (int y = first; y <= last; ++y)
            if (near(segment, y, y)) lowerRow(y, segment, members, distance);
    }
}

} // namespace

void lowerToEdgeDistance(const std::vector<PixelEdge>& edges, const PlaneWinding& winding,
                         const Image<std::uint8_t>& members, int threads, Image<float>& distance) {
    const VisibleBoundary boundary(edges, winding, members);
    std::vector<std::vector<Piece>> rows(boundary.rows());
    inParallel(boundary.rows(), threads, [&](int row) { rows[row] = boundary.piecesIn(row); });
    std::vector<Piece> pieces;
    for (const std::vector<Piece>& row : rows) pieces.insert(pieces.end(), row.begin(), row.end());
    const std::vector<Segment> segments = joined(pieces, edges);

    constexpr int band = 16;
    const int height = members.height();
    inParallel((height + band - 1) / band, threads,
               [&](int i) { lowerBand(i * band, std::min((i + 1) * band, height) - 1, segments, members, distance); });
}

} // namespace shadowbench::groundtruth::hard
