// A light's shape and what hides it, cut into rows in which no two edges meet.
#pragma once

#include "groundtruth/cgal/area/area_shape.h"
#include "groundtruth/cgal/area/area_view.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth::area {

inline constexpr double unit = 0x1p-53; // relative rounding error of one operation

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

/// The part of a slab between two shares of its height; its edges from left to right in the middle, where `place` is.
struct Row {
    const std::vector<UpwardEdge*>& edges;
    double bottom, top; // of the slab
    double from, to;    // shares of its height
};

/// The edges around what hides the light, and around the two polygons of its shape.
std::vector<UpwardEdge> upwardEdges(const std::vector<CoverEdge>& edges, const LightShape& shape);

/// Goes through the rows from the lowest to the highest.
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

    template <typename Visit>
    void visitRows(const Visit& visit) {
        std::size_t next = 0;
        for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
            const double bottom = heights_[i], top = heights_[i + 1];
            std::erase_if(active_, [&](const UpwardEdge* e) { return e->high.y <= bottom; });
            while (next < edges_.size() && edges_[next].low.y <= bottom) active_.push_back(&edges_[next++]);
            visitSlab(bottom, top, visit);
        }
    }

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

    template <typename Visit>
    void visitSlab(double bottom, double top, const Visit& visit) {
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
            if (crossings_[i] < crossings_[i + 1]) visitRow({active_, bottom, top, crossings_[i], crossings_[i + 1]}, visit);
    }

    template <typename Visit>
    void visitRow(const Row& row, const Visit& visit) {
        const double middle = 0.5 * (row.from + row.to);
        for (UpwardEdge* edge : active_) edge->place = edge->bottom + middle * (edge->top - edge->bottom);
        sortActive([](const UpwardEdge& e) { return e.place; }, [](const UpwardEdge&, const UpwardEdge&) {});
        visit(row);
    }

    std::vector<UpwardEdge> edges_;
    std::vector<double> heights_;
    std::vector<UpwardEdge*> active_;
    std::vector<double> crossings_; // shares of the slab's height
};

} // namespace shadowbench::groundtruth::area
