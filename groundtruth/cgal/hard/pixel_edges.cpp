#include "groundtruth/cgal/hard/pixel_edges.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace shadowbench::groundtruth::hard {
namespace {

struct Pixel {
    int x, y;
};

bool isReceiver(Surface surface) { return surface == Surface::Receiver || surface == Surface::OnEdge; }

/// Is there a shadow edge between two neighbouring pixels?
bool differ(const Reference& r, Pixel a, Pixel b) {
    const Surface sa = r.surface(a.x, a.y), sb = r.surface(b.x, b.y);
    if (sa == Surface::Receiver && sb == Surface::Receiver) return r.visibility(a.x, a.y) != r.visibility(b.x, b.y);
    if (r.id(a.x, a.y) != r.id(b.x, b.y)) return false;
    if (sa == Surface::FacesAway) return sb == Surface::Receiver && r.visibility(b.x, b.y) == 1;
    if (sb == Surface::FacesAway) return sa == Surface::Receiver && r.visibility(a.x, a.y) == 1;
    return false;
}

/// A point of an edge, and the surface whose receivers it is one for.
struct EdgePoint {
    glm::dvec2 at;
    std::uint32_t id;
};

/// Edges between the pixels of a row and their neighbours to the right and below.
struct RowEdges {
    std::vector<EdgePoint> points;
    std::vector<Pixel> beside; // receivers that an edge passes
};

void listBetween(const Reference& r, Pixel a, Pixel b, RowEdges& edges) {
    if (!r.id.contains(b.x, b.y) || !differ(r, a, b)) return;
    const glm::dvec2 middle(0.5 * (a.x + b.x) + 0.5, 0.5 * (a.y + b.y) + 0.5);
    const std::uint32_t idA = r.id(a.x, a.y), idB = r.id(b.x, b.y);
    edges.points.push_back({middle, idA});
    if (idB != idA) edges.points.push_back({middle, idB});
    for (const Pixel p : {a, b})
        if (isReceiver(r.surface(p.x, p.y))) edges.beside.push_back(p);
}

RowEdges edgesOfRow(const Reference& r, int y) {
    RowEdges edges;
    for (int x = 0; x < r.id.width(); ++x) {
        for (const Pixel next : {Pixel{x + 1, y}, Pixel{x - 1, y + 1}, Pixel{x, y + 1}, Pixel{x + 1, y + 1}})
            listBetween(r, {x, y}, next, edges);
        if (r.surface(x, y) == Surface::OnEdge) edges.points.push_back({{x + 0.5, y + 0.5}, r.id(x, y)});
    }
    return edges;
}

/// Lowers the distances in row `y` of the receivers that the point is one for.
void spread(Reference& r, const EdgePoint& point, int y) {
    const double down = y + 0.5 - point.at.y;
    if (std::abs(down) > edgeReach) return;
    const int left = std::max(0, static_cast<int>(point.at.x - 0.5 - edgeReach));
    const int right = std::min(r.id.width() - 1, static_cast<int>(point.at.x + edgeReach));
    for (int x = left; x <= right; ++x) {
        if (r.id(x, y) != point.id || !isReceiver(r.surface(x, y))) continue;
        const double distance = glm::distance(glm::dvec2(x + 0.5, y + 0.5), point.at);
        if (distance > edgeReach) continue;
        r.edgeDistance(x, y) = std::min(r.edgeDistance(x, y), static_cast<float>(std::max(0.5, distance)));
    }
}

} // namespace

void edgeDistanceFromLabels(Reference& out, int threads) {
    const int height = out.id.height(), reach = static_cast<int>(edgeReach) + 1;
    std::vector<RowEdges> rows(height);
    inParallel(height, threads, [&](int y) { rows[y] = edgesOfRow(out, y); });
    inParallel(height, threads, [&](int y) {
        for (int x = 0; x < out.id.width(); ++x) out.edgeDistance(x, y) = std::numeric_limits<float>::infinity();
        for (int row = std::max(0, y - reach); row <= std::min(height - 1, y + reach); ++row)
            for (const EdgePoint& point : rows[row].points) spread(out, point, y);
        for (int row = std::max(0, y - 1); row <= y; ++row)
            for (const Pixel p : rows[row].beside)
                if (p.y == y) out.edgeDistance(p.x, y) = std::min(out.edgeDistance(p.x, y), 0.5F);
        for (int x = 0; x < out.id.width(); ++x)
            if (out.surface(x, y) == Surface::OnEdge) out.edgeDistance(x, y) = 0;
    });
}

} // namespace shadowbench::groundtruth::hard
