#include "techniques/maps/sm-adaptive/refinement.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <span>
#include <tuple>

namespace shadowbench::techniques {
namespace {

struct Node {
    Page page;
    std::span<Demand> demands; // of the pixels that lie in the page, never empty
    double excess;             // pixels that its texels are too long, summed over them
};

double excessOf(std::span<const Demand> demands, const Page& page, const Refinement& limits) {
    const double texels = static_cast<double>(limits.texels) * (1 << page.level);
    double sum = 0;
    for (const Demand& demand : demands) {
        const double longest = static_cast<double>(std::max(demand.pixels.x, demand.pixels.y)) / texels;
        sum += std::max(0.0, longest - 1 / limits.density);
    }
    return sum;
}

/// Whether `a` is cut after `b`. Equal excess: in the order of planes, levels, rows.
bool cutAfter(const Node& a, const Node& b) {
    const auto place = [](const Page& p) { return std::tuple(p.plane, p.level, p.at.y, p.at.x); };
    return a.excess != b.excess ? a.excess < b.excess : place(a.page) > place(b.page);
}

/// The node's quarters that hold demands.
std::vector<Node> cut(const Node& node, const Refinement& limits) {
    const int level = node.page.level + 1;
    const glm::ivec2 middle = 2 * node.page.at + 1; // cells of that level
    const auto isHigh = [&](int axis) {
        return [=](const Demand& d) { return cellOf(d.at, 1 << level)[axis] >= middle[axis]; };
    };
    const auto halves = [&](std::span<Demand> all, int axis) {
        const auto high = std::partition(all.begin(), all.end(), std::not_fn(isHigh(axis)));
        return std::array{std::span<Demand>(all.begin(), high), std::span<Demand>(high, all.end())};
    };
    std::vector<Node> quarters;
    const auto rows = halves(node.demands, 1);
    for (int y = 0; y < 2; ++y) {
        const auto columns = halves(rows[static_cast<std::size_t>(y)], 0);
        for (int x = 0; x < 2; ++x) {
            const std::span<Demand> demands = columns[static_cast<std::size_t>(x)];
            if (demands.empty()) continue;
            const Page page{node.page.plane, level, 2 * node.page.at + glm::ivec2(x, y)};
            quarters.push_back({page, demands, excessOf(demands, page, limits)});
        }
    }
    return quarters;
}

std::vector<Node> roots(std::vector<Demand>& demands, const Refinement& limits) {
    std::sort(demands.begin(), demands.end(), [](const Demand& a, const Demand& b) {
        return std::tuple(a.plane, a.at.y, a.at.x) < std::tuple(b.plane, b.at.y, b.at.x);
    });
    std::vector<Node> nodes;
    for (auto first = demands.begin(); first != demands.end();) {
        const auto last = std::find_if(first, demands.end(), [&](const Demand& d) { return d.plane != first->plane; });
        const Page page{first->plane, 0, {0, 0}};
        const std::span<Demand> own(first, last);
        nodes.push_back({page, own, excessOf(own, page, limits)});
        first = last;
    }
    return nodes;
}

} // namespace

std::vector<Page> refine(std::vector<Demand> demands, const Refinement& limits) {
    const std::vector<Node> first = roots(demands, limits);
    std::priority_queue open(first.begin(), first.end(), cutAfter);
    std::size_t count = first.size();
    std::vector<Page> leaves;
    while (!open.empty()) {
        const Node node = open.top();
        open.pop();
        if (node.excess > 0 && node.page.level < limits.levels) {
            const std::vector<Node> quarters = cut(node, limits);
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
