#include "groundtruth/cgal/hard/pixel_edges.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

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

/// Lowers the distances of the receivers of surface `id` around an edge point.
void spread(Reference& r, glm::dvec2 point, std::uint32_t id) {
    const int left = std::max(0, static_cast<int>(point.x - 0.5 - edgeReach));
    const int right = std::min(r.id.width() - 1, static_cast<int>(point.x + edgeReach));
    const int top = std::max(0, static_cast<int>(point.y - 0.5 - edgeReach));
    const int bottom = std::min(r.id.height() - 1, static_cast<int>(point.y + edgeReach));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            if (r.id(x, y) != id || !isReceiver(r.surface(x, y))) continue;
            const double distance = glm::distance(glm::dvec2(x + 0.5, y + 0.5), point);
            if (distance > edgeReach) continue;
            r.edgeDistance(x, y) = std::min(r.edgeDistance(x, y), static_cast<float>(std::max(0.5, distance)));
        }
    }
}

void spreadBetween(Reference& r, Pixel a, Pixel b) {
    if (!r.id.contains(b.x, b.y) || !differ(r, a, b)) return;
    const glm::dvec2 middle(0.5 * (a.x + b.x) + 0.5, 0.5 * (a.y + b.y) + 0.5);
    const std::uint32_t idA = r.id(a.x, a.y), idB = r.id(b.x, b.y);
    spread(r, middle, idA);
    if (idB != idA) spread(r, middle, idB);
    for (const Pixel p : {a, b})
        if (isReceiver(r.surface(p.x, p.y))) r.edgeDistance(p.x, p.y) = std::min(r.edgeDistance(p.x, p.y), 0.5F);
}

} // namespace

void edgeDistanceFromLabels(Reference& out) {
    std::ranges::fill(out.edgeDistance, std::numeric_limits<float>::infinity());
    for (int y = 0; y < out.id.height(); ++y) {
        for (int x = 0; x < out.id.width(); ++x) {
            const Pixel here{x, y};
            for (const Pixel next : {Pixel{x + 1, y}, Pixel{x - 1, y + 1}, Pixel{x, y + 1}, Pixel{x + 1, y + 1}})
                spreadBetween(out, here, next);
            if (out.surface(x, y) == Surface::OnEdge) spread(out, {x + 0.5, y + 0.5}, out.id(x, y));
        }
    }
    for (std::size_t i = 0; i < out.surface.size(); ++i)
        if (out.surface[i] == Surface::OnEdge) out.edgeDistance[i] = 0;
}

} // namespace shadowbench::groundtruth::hard
