// Displacement of shadow edges; the estimator is described at edgeError() in table.h.
#include "harness/metrics/pixels.h"
#include "harness/metrics/thresholds.h"

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

/// The islands of an image: regions of wrong labels away from every exact edge.
class Islands {
public:
    Islands(const ScoredFrame& frame, const std::vector<EdgePoint>& exact, double reach)
        : frame_(frame), exact_(exact), reach_(reach), nearest_(exact), seen_(frame.v.width(), frame.v.height()),
          islands_(frame.v.width(), frame.v.height()) {
        for (int y = 0; y < frame.v.height(); ++y)
            for (int x = 0; x < frame.v.width(); ++x) {
                if (seen_(x, y) != 0 || !isWrong({x, y})) continue;
                const std::vector<glm::ivec2> region = regionFrom({x, y});
                if (std::ranges::any_of(region, [&](glm::ivec2 pixel) { return isNearEdge(pixel); })) continue;
                ++count_;
                for (const glm::ivec2 pixel : region) islands_(pixel.x, pixel.y) = 1;
            }
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool outline(const EdgePoint& p) const {
        return islands_(p.pair.a.x, p.pair.a.y) != 0 || islands_(p.pair.b.x, p.pair.b.y) != 0;
    }

private:
    [[nodiscard]] bool isWrong(glm::ivec2 p) const {
        return frame_.mask.scored(p.x, p.y) != 0 && isLit(frame_.v(p.x, p.y)) != isLit(frame_.truth.visibility(p.x, p.y));
    }

    [[nodiscard]] bool isNearEdge(glm::ivec2 pixel) const {
        const glm::dvec2 centre = glm::dvec2(pixel) + 0.5;
        return glm::distance(exact_[nearest_.to(centre)].position(), centre) <= reach_;
    }

    std::vector<glm::ivec2> regionFrom(glm::ivec2 first) {
        std::vector<glm::ivec2> region{first};
        seen_(first.x, first.y) = 1;
        for (std::size_t i = 0; i < region.size(); ++i) {
            const glm::ivec2 here = region[i];
            for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                const glm::ivec2 next = here + step;
                if (!seen_.contains(next.x, next.y) || seen_(next.x, next.y) != 0 || !isWrong(next)) continue;
                if (frame_.truth.id(next.x, next.y) != frame_.truth.id(here.x, here.y)) continue;
                seen_(next.x, next.y) = 1;
                region.push_back(next);
            }
        }
        return region;
    }

    const ScoredFrame& frame_;
    const std::vector<EdgePoint>& exact_;
    double reach_; // pixels between a region and an exact edge that it belongs to
    NearestPoint nearest_;
    Image<std::uint8_t> seen_, islands_;
    std::size_t count_ = 0;
};

/// Displacements both ways.
struct Displacements {
    std::vector<double> absolute;
    double signedSum = 0, largest = 0;
    std::size_t missing = 0; // points of the exact edge
};

Displacements displacements(const std::vector<EdgePoint>& technique, const std::vector<EdgePoint>& exact,
                            const groundtruth::Reference& truth, double farthest) {
    const NearestPoint nearestExact(exact), nearestTechnique(technique);
    Displacements result;
    const auto add = [&](double moved) {
        result.absolute.push_back(std::abs(moved));
        result.largest = std::max(result.largest, std::abs(moved));
    };
    for (const EdgePoint& p : technique) {
        const double moved = displacement(p, exact[nearestExact.to(p.position())], truth);
        result.signedSum += moved;
        add(moved);
    }
    for (const EdgePoint& q : exact) {
        const EdgePoint& p = technique[nearestTechnique.to(q.position())];
        const double distance = glm::distance(q.position(), p.position());
        result.largest = std::max(result.largest, distance);
        if (distance > farthest)
            ++result.missing;
        else
            add(displacement(p, q, truth));
    }
    return result;
}

} // namespace

std::optional<EdgeError> edgeError(const ScoredFrame& frame) { return edgeErrorBy({}, frame); }

std::optional<EdgeError> edgeErrorBy(const Thresholds& near, const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    const std::vector<EdgePoint> exact = exactEdge(truth, mask, isHard(v, mask));
    if (exact.empty()) return {};
    const Islands islands(frame, exact, near.island);
    EdgeError result;
    result.islands = static_cast<double>(islands.count());
    std::vector<EdgePoint> technique = techniqueEdge(v, truth, mask);
    std::erase_if(technique, [&](const EdgePoint& p) { return islands.outline(p); });
    if (technique.empty()) {
        result.missing = 1;
        return result;
    }
    Displacements found = displacements(technique, exact, truth, near.missingEdge);
    result.missing = static_cast<double>(found.missing) / static_cast<double>(exact.size());
    result.mean = mean(found.absolute);
    result.median = quantile(found.absolute, 0.5);
    result.p95 = quantile(found.absolute, 0.95);
    result.hausdorff = found.largest;
    result.signedMean = found.signedSum / static_cast<double>(technique.size());
    return result;
}

} // namespace shadowbench::metrics
