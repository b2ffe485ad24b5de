#include "groundtruth/cgal/area/area_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::area {
namespace {

constexpr double unit = 0x1p-53; // relative rounding error of one operation

/// What changes from left to right across an edge.
struct Change {
    int covers = 0, inner = 0, outer = 0;
};

/// An edge that runs upwards, and its places in the slab at hand.
struct UpwardEdge {
    glm::dvec2 low, high;
    Change change;
    double bottom = 0, top = 0; // of the slab
    double place = 0;           // at the height at hand

    [[nodiscard]] double at(double height) const { return low.x + (high.x - low.x) * ((height - low.y) / (high.y - low.y)); }
};

/// `change` is that of an edge that runs downwards, which has more to its left.
void addEdge(const glm::dvec2& from, const glm::dvec2& to, const Change& change, std::vector<UpwardEdge>& edges) {
    if (to.y < from.y) edges.push_back({to, from, change});
    if (to.y > from.y) edges.push_back({from, to, {-change.covers, -change.inner, -change.outer}});
}

void addPolygon(const LightPolygon& polygon, const Change& change, std::vector<UpwardEdge>& edges) {
    for (std::size_t i = 0; i < polygon.size(); ++i) addEdge(polygon[i], polygon[(i + 1) % polygon.size()], change, edges);
}

class Sweep {
public:
    explicit Sweep(std::vector<UpwardEdge> edges) : edges_(std::move(edges)) {
        std::ranges::sort(edges_, {}, [](const UpwardEdge& e) { return e.low.y; });
        for (const UpwardEdge& edge : edges_) {
            heights_.push_back(edge.low.y);
            heights_.push_back(edge.high.y);
        }
        std::ranges::sort(heights_);
        heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
    }

    LightAreas run() {
        std::size_t next = 0;
        for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
            const double bottom = heights_[i], top = heights_[i + 1];
            std::erase_if(active_, [&](const UpwardEdge* e) { return e->high.y <= bottom; });
            while (next < edges_.size() && edges_[next].low.y <= bottom) active_.push_back(&edges_[next++]);
            addSlab(bottom, top);
        }
        return areas_;
    }

    [[nodiscard]] std::size_t slabs() const { return slabs_; }

private:
    /// Insertion sort by `key`: neighbouring rows have nearly the same order. `swapped` sees every pair that changes places.
    template <typename Key, typename Swapped>
    void sortActive(const Key& key, const Swapped& swapped) {
        for (std::size_t i = 1; i < active_.size(); ++i) {
            UpwardEdge* const edge = active_[i];
            const double place = key(*edge);
            std::size_t j = i;
            for (; j > 0 && key(*active_[j - 1]) > place; --j) {
                swapped(*active_[j - 1], *edge);
                active_[j] = active_[j - 1];
            }
            active_[j] = edge;
        }
    }

    void addSlab(double bottom, double top) {
        for (UpwardEdge* edge : active_) {
            edge->bottom = edge->at(bottom);
            edge->top = edge->at(top);
        }
        sortActive([](const UpwardEdge& e) { return e.bottom; }, [](const UpwardEdge&, const UpwardEdge&) {});
        crossings_.assign(1, 0.0);
        sortActive([](const UpwardEdge& e) { return e.top; },
                   [&](const UpwardEdge& a, const UpwardEdge& b) { // a was left of b and ends right of it
                       const double before = b.bottom - a.bottom, after = a.top - b.top;
                       crossings_.push_back(before / (before + after));
                   });
        crossings_.push_back(1);
        std::ranges::sort(crossings_);
        for (std::size_t i = 0; i + 1 < crossings_.size(); ++i)
            if (crossings_[i] < crossings_[i + 1]) addRow(top - bottom, crossings_[i], crossings_[i + 1]);
    }

    /// Adds the part of the slab between two shares of its height, in which no edges cross: gaps at half the height count.
    void addRow(double height, double from, double to) {
        ++slabs_;
        const double middle = 0.5 * (from + to);
        for (UpwardEdge* edge : active_) edge->place = edge->bottom + middle * (edge->top - edge->bottom);
        sortActive([](const UpwardEdge& e) { return e.place; }, [](const UpwardEdge&, const UpwardEdge&) {});

        LightAreas lengths{};
        Change now;
        double left = 0;
        for (const UpwardEdge* edge : active_) {
            const double gap = edge->place - left;
            if (now.inner > 0) (now.covers > 0 ? lengths.innerHidden : lengths.innerVisible) += gap;
            if (now.outer > 0) (now.covers > 0 ? lengths.outerHidden : lengths.outerVisible) += gap;
            now.covers += edge->change.covers;
            now.inner += edge->change.inner;
            now.outer += edge->change.outer;
            left = edge->place;
        }
        const double row = (to - from) * height;
        areas_.innerVisible += row * lengths.innerVisible;
        areas_.innerHidden += row * lengths.innerHidden;
        areas_.outerVisible += row * lengths.outerVisible;
        areas_.outerHidden += row * lengths.outerHidden;
    }

    std::vector<UpwardEdge> edges_;
    std::vector<double> heights_;
    std::vector<UpwardEdge*> active_;
    std::vector<double> crossings_; // shares of the slab's height
    std::size_t slabs_ = 0;
    LightAreas areas_{};
};

/// Edges meet in the same rows as the true ones, each end moved by e per coordinate at most: an edge sweeps at most
/// (length + 3 e) · 3 e; in every row that it crosses its place
/// is rounded by some units, and so is the sum over the gaps; each row's height by one, the running sums by one.
double errorBound(const std::vector<CoverEdge>& edges, const LightShape& shape, std::size_t rows) {
    double error = 0;
    for (const CoverEdge& edge : edges) {
        error += 3 * edge.error * (glm::distance(edge.from, edge.to) + 3 * edge.error);
        error += 16 * unit * std::abs(edge.to.y - edge.from.y);
    }
    const double shapeEdges = shape.area < 1 ? 4 : 2; // that a row crosses
    return error + unit * (16 * shapeEdges + 8 * static_cast<double>(rows));
}

} // namespace

SweptAreas sweepAreas(const std::vector<CoverEdge>& edges, const LightShape& shape) {
    std::vector<UpwardEdge> all;
    all.reserve(edges.size() + shape.inner.size() + shape.outer.size());
    for (const CoverEdge& edge : edges) addEdge(edge.from, edge.to, {edge.covers, 0, 0}, all);
    addPolygon(shape.inner, {0, 1, 0}, all);
    addPolygon(shape.outer, {0, 0, 1}, all);
    Sweep sweep(std::move(all));
    const LightAreas areas = sweep.run();
    return {areas, errorBound(edges, shape, sweep.slabs())};
}

VisibleLength visibleLength(std::vector<CoverInterval> hidden) {
    std::ranges::sort(hidden, {}, &CoverInterval::from);
    VisibleLength result{0, 0};
    double reached = -0.5;
    for (const CoverInterval& part : hidden) {
        if (part.from > reached) result.visible += part.from - reached;
        reached = std::max(reached, part.to);
        result.error += 2 * part.error + 4 * unit;
    }
    if (reached < 0.5) result.visible += 0.5 - reached;
    return result;
}

} // namespace shadowbench::groundtruth::area
