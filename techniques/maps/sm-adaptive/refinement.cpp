#include "techniques/maps/sm-adaptive/refinement.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <queue>
#include <span>

namespace shadowbench::techniques {
namespace {

/// Bits of `x` with a zero before each.
std::uint32_t spread(std::uint32_t x) {
    static_assert(finestLevel <= 8);
    x = (x | (x << 4U)) & 0x0F0FU;
    x = (x | (x << 2U)) & 0x3333U;
    return (x | (x << 1U)) & 0x5555U;
}

/// The demands of a plane along a Z curve over the cells of the finest level, so that those of any page lie together.
class SortedDemands {
public:
    SortedDemands(std::span<const Demand> demands, int plane) : begin_((std::size_t{1} << (2U * finestLevel)) + 1, 0) {
        for (const Demand& demand : demands)
            if (demand.plane == plane) ++begin_[place(demand) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        longest_.resize(begin_.back());
        std::vector<std::uint32_t> next = begin_;
        for (const Demand& demand : demands)
            if (demand.plane == plane) longest_[next[place(demand)]++] = std::max(demand.pixels.x, demand.pixels.y);
    }

    /// The longer side of the plane's map in pixels, at each of the page's demands.
    [[nodiscard]] std::span<const float> in(const Page& page) const {
        const auto shift = static_cast<unsigned>(2 * (finestLevel - page.level));
        const std::size_t cell = code(page.at);
        const std::size_t first = begin_[cell << shift], last = begin_[(cell + 1) << shift];
        return {longest_.data() + first, longest_.data() + last};
    }

private:
    static std::size_t code(glm::ivec2 cell) {
        return spread(static_cast<std::uint32_t>(cell.x)) | (spread(static_cast<std::uint32_t>(cell.y)) << 1U);
    }
    static std::size_t place(const Demand& demand) { return code(cellOf(demand.at, 1 << finestLevel)); }

    std::vector<std::uint32_t> begin_; // of each cell's demands, and the end of all
    std::vector<float> longest_;
};

struct Node {
    Page page;
    bool tooCoarse;      // for more of its pixels than may be
    std::int64_t excess; // pixels that its texels are too long, summed over its pixels, in 2⁻¹⁶: whole, so that the order
                         // of pixels does not matter
};

/// Whether `a` is cut after `b`. Equal excess: in the order of pages.
bool cutAfter(const Node& a, const Node& b) { return a.excess != b.excess ? a.excess < b.excess : b.page < a.page; }

class Quadtree {
public:
    Quadtree(std::span<const Demand> demands, const Refinement& limits) : limits_(limits) {
        int planes = 0;
        for (const Demand& demand : demands) planes = std::max(planes, demand.plane + 1);
        for (int plane = 0; plane < planes; ++plane) demands_.emplace_back(demands, plane);
    }

    [[nodiscard]] std::vector<Node> roots() const {
        std::vector<Node> nodes;
        for (int plane = 0; plane < static_cast<int>(demands_.size()); ++plane) add({plane, 0, {0, 0}}, nodes);
        return nodes;
    }

    /// The node's quarters that hold demands.
    [[nodiscard]] std::vector<Node> cut(const Page& page) const {
        std::vector<Node> quarters;
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) add({page.plane, page.level + 1, 2 * page.at + glm::ivec2(x, y)}, quarters);
        return quarters;
    }

private:
    void add(const Page& page, std::vector<Node>& nodes) const {
        const std::span<const float> demands = demands_[static_cast<std::size_t>(page.plane)].in(page);
        if (demands.empty()) return;
        const auto texels = static_cast<float>(limits_.texels * (1 << page.level));
        const auto allowed = static_cast<float>(1 / limits_.density);
        std::size_t tooShort = 0;
        std::int64_t excess = 0;
        for (const float longest : demands) {
            const float over = longest / texels - allowed;
            if (over <= 0) continue;
            ++tooShort;
            excess += static_cast<std::int64_t>(over * 65536);
        }
        const bool tooCoarse = static_cast<double>(tooShort) > (1 - limits_.share) * static_cast<double>(demands.size());
        nodes.push_back({page, tooCoarse, excess});
    }

    Refinement limits_;
    std::vector<SortedDemands> demands_; // by plane
};

} // namespace

std::vector<Page> refine(const std::vector<Demand>& demands, const Refinement& limits) {
    const Quadtree tree(demands, limits);
    const std::vector<Node> first = tree.roots();
    std::priority_queue open(first.begin(), first.end(), cutAfter);
    std::size_t count = first.size();
    std::vector<Page> leaves;
    while (!open.empty()) {
        const Node node = open.top();
        open.pop();
        if (node.tooCoarse && node.page.level < limits.levels) {
            const std::vector<Node> quarters = tree.cut(node.page);
            if (count + quarters.size() - 1 <= static_cast<std::size_t>(limits.pages)) {
                count += quarters.size() - 1;
                for (const Node& quarter : quarters) open.push(quarter);
                continue;
            }
        }
        leaves.push_back(node.page);
    }
    return leaves;
}

} // namespace shadowbench::techniques
