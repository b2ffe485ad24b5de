// Displacement of shadow edges; the estimator is described at edgeError() in table.h.
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::metrics {
namespace {

namespace index = boost::geometry::index;
using Point = boost::geometry::model::d2::point_xy<double>;
using Entry = std::pair<Point, std::size_t>;

/// A sample of an edge: a position between two pixels.
struct EdgePoint {
    Crossing pair;
    double share;
    [[nodiscard]] glm::dvec2 position() const { return between(pair, share); }
};

class NearestPoint {
public:
    explicit NearestPoint(const std::vector<EdgePoint>& points) : tree_(entries(points)) {}

    [[nodiscard]] std::size_t to(glm::dvec2 p) const { return tree_.qbegin(index::nearest(Point(p.x, p.y), 1))->second; }

private:
    static std::vector<Entry> entries(const std::vector<EdgePoint>& points) {
        std::vector<Entry> result;
        result.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec2 p = points[i].position();
            result.emplace_back(Point(p.x, p.y), i);
        }
        return result;
    }

    index::rtree<Entry, index::rstar<16>> tree_;
};

bool isHard(const Image<float>& v, const Mask& mask) {
    for (std::size_t i = 0; i < v.size(); ++i)
        if (mask.scored[i] && v[i] != 0.0F && v[i] != 1.0F) return false;
    return true;
}

/// Exact distance to the edge, positive where V* is lit.
double signedDistance(const groundtruth::Reference& truth, glm::ivec2 pixel) {
    const double distance = truth.edgeDistance(pixel.x, pixel.y);
    return isLit(truth.visibility(pixel.x, pixel.y)) ? distance : -distance;
}

bool hasDistance(const groundtruth::Reference& truth, const Crossing& pair) {
    return std::isfinite(truth.edgeDistance(pair.a.x, pair.a.y)) && std::isfinite(truth.edgeDistance(pair.b.x, pair.b.y));
}

double signedDistance(const groundtruth::Reference& truth, const EdgePoint& point) {
    return std::lerp(signedDistance(truth, point.pair.a), signedDistance(truth, point.pair.b), point.share);
}

std::vector<EdgePoint> techniqueEdge(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask) {
    std::vector<EdgePoint> points;
    for (const Crossing& pair : crossings(v, truth, mask)) points.push_back({pair, halfCrossing(v, pair)});
    return points;
}

std::vector<EdgePoint> exactEdge(const groundtruth::Reference& truth, const Mask& mask, bool halfway) {
    std::vector<EdgePoint> points;
    for (const Crossing& pair : crossings(truth.visibility, truth, mask)) {
        const double a = truth.edgeDistance(pair.a.x, pair.a.y);
        const double b = truth.edgeDistance(pair.b.x, pair.b.y);
        const bool placed = !halfway && hasDistance(truth, pair) && a + b > 0;
        points.push_back({pair, placed ? a / (a + b) : 0.5});
    }
    return points;
}

double displacement(const EdgePoint& p, const EdgePoint& q, const groundtruth::Reference& truth) {
    if (hasDistance(truth, p.pair) && hasDistance(truth, q.pair)) return signedDistance(truth, p) - signedDistance(truth, q);
    const glm::ivec2 nearer = p.share < 0.5 ? p.pair.a : p.pair.b;
    const double distance = glm::distance(p.position(), q.position());
    return isLit(truth.visibility(nearer.x, nearer.y)) ? distance : -distance;
}

} // namespace

std::optional<EdgeError> edgeError(const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    const std::vector<EdgePoint> technique = techniqueEdge(v, truth, mask);
    const std::vector<EdgePoint> exact = exactEdge(truth, mask, isHard(v, mask));
    if (technique.empty() || exact.empty()) return {};

    const NearestPoint nearestExact(exact);
    const NearestPoint nearestTechnique(technique);
    EdgeError result;
    std::vector<double> distances;
    distances.reserve(technique.size());
    for (const EdgePoint& p : technique) {
        const double moved = displacement(p, exact[nearestExact.to(p.position())], truth);
        result.signedMean += moved / static_cast<double>(technique.size());
        distances.push_back(std::abs(moved));
    }
    result.mean = mean(distances);
    result.p95 = quantile(distances, 0.95);
    result.hausdorff = distances.back(); // sorted by quantile()
    for (const EdgePoint& q : exact) {
        const EdgePoint& p = technique[nearestTechnique.to(q.position())];
        result.hausdorff = std::max(result.hausdorff, glm::distance(q.position(), p.position()));
    }
    return result;
}

} // namespace shadowbench::metrics
