#include "techniques/maps/sm-tiled/tiling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <optional>
#include <tuple>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr int leastTexels = 8; // along a tile's side

/// Demands of a rectangle of cells: pixels along x and y, summed, and how many there are.
struct Sum {
    glm::dvec2 pixels{0};
    double count = 0;
    Sum& operator+=(const Sum& other) {
        pixels += other.pixels;
        count += other.count;
        return *this;
    }
    Sum& operator-=(const Sum& other) {
        pixels -= other.pixels;
        count -= other.count;
        return *this;
    }
};

/// Summed-area tables over the planes' cells.
class DemandSums {
public:
    DemandSums(std::span<const Demand> demands, int planes, int cells)
        : line_(static_cast<std::size_t>(cells) + 1), sums_(static_cast<std::size_t>(planes) * line_ * line_) {
        for (const Demand& demand : demands) {
            const glm::ivec2 cell = cellOf(demand.at, cells);
            corner(demand.plane, cell + 1) += {glm::dvec2(demand.pixels), 1};
        }
        for (int plane = 0; plane < planes; ++plane)
            for (int y = 1; y <= cells; ++y)
                for (int x = 1; x <= cells; ++x) {
                    Sum& here = corner(plane, {x, y});
                    here += corner(plane, {x - 1, y});
                    here += corner(plane, {x, y - 1});
                    here -= corner(plane, {x - 1, y - 1});
                }
    }

    [[nodiscard]] Sum over(int plane, glm::ivec2 at, glm::ivec2 size) const {
        const glm::ivec2 end = at + size;
        Sum sum = corner(plane, end);
        sum -= corner(plane, {at.x, end.y});
        sum -= corner(plane, {end.x, at.y});
        sum += corner(plane, at);
        return sum;
    }

private:
    [[nodiscard]] std::size_t index(int plane, glm::ivec2 at) const {
        return (static_cast<std::size_t>(plane) * line_ + static_cast<std::size_t>(at.y)) * line_ +
               static_cast<std::size_t>(at.x);
    }
    Sum& corner(int plane, glm::ivec2 at) { return sums_[index(plane, at)]; }
    [[nodiscard]] const Sum& corner(int plane, glm::ivec2 at) const { return sums_[index(plane, at)]; }

    std::size_t line_;
    std::vector<Sum> sums_;
};

class Tiling {
public:
    Tiling(std::span<const Demand> demands, int planes, int cells)
        : planes_(planes), cells_(cells), sums_(demands, planes, cells) {}

    [[nodiscard]] std::vector<PlaneTile> tiles(int side, int count) const {
        std::vector<PlaneTile> tiles = wholePlanes();
        shareOut(tiles, {{0, 0}, {side, side}});
        std::vector<std::optional<Cut>> cuts;
        for (const PlaneTile& tile : tiles) cuts.push_back(bestCut(tile));
        while (tiles.size() < static_cast<std::size_t>(count)) {
            const auto best = std::max_element(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) {
                return (a ? a->saved : 0) < (b ? b->saved : 0);
            });
            if (best == cuts.end() || !*best) break;
            const auto [low, high] = (*best)->parts;
            tiles[static_cast<std::size_t>(best - cuts.begin())] = low;
            *best = bestCut(low);
            tiles.push_back(high);
            cuts.push_back(bestCut(high));
        }
        return tiles;
    }

private:
    struct Cut {
        double saved; // expected error: > 0
        std::pair<PlaneTile, PlaneTile> parts;
    };

    [[nodiscard]] Sum over(const PlaneTile& tile) const { return sums_.over(tile.plane, tile.at, tile.size); }

    /// Pixels along x and y times the tile's size: the expected error of a tile of one texel.
    [[nodiscard]] glm::dvec2 weight(const PlaneTile& tile) const {
        return glm::max(over(tile).pixels, 0.0) * glm::dvec2(tile.size) / static_cast<double>(cells_); // sums round
    }

    [[nodiscard]] double expectedError(const PlaneTile& tile) const {
        const glm::dvec2 error = weight(tile) / glm::dvec2(tile.texels.size);
        return error.x + error.y;
    }

    /// The smallest rectangle of the tile's cells that holds its demands, of which there must be some.
    [[nodiscard]] PlaneTile narrowed(PlaneTile tile) const {
        for (int axis = 0; axis < 2; ++axis) {
            // Cells from either end of the tile that hold nothing, by bisection: the sum over more of them only grows.
            const auto emptyCells = [&](bool fromLow) {
                int empty = 0, some = tile.size[axis];
                while (some - empty > 1) {
                    const int cells = (empty + some) / 2;
                    PlaneTile end = tile;
                    end.size[axis] = cells;
                    if (!fromLow) end.at[axis] += tile.size[axis] - cells;
                    (over(end).count > 0 ? some : empty) = cells;
                }
                return empty;
            };
            const int low = emptyCells(true), high = emptyCells(false);
            tile.at[axis] += low;
            tile.size[axis] -= low + high;
        }
        return tile;
    }

    [[nodiscard]] std::vector<PlaneTile> wholePlanes() const {
        std::vector<PlaneTile> tiles;
        for (int plane = 0; plane < planes_; ++plane) {
            const PlaneTile whole{plane, {0, 0}, glm::ivec2(cells_), {}};
            if (over(whole).count > 0) tiles.push_back(narrowed(whole));
        }
        return tiles;
    }

    /// Cuts `texels` in two until each tile has its rectangle. The expected errors w / √n of n texels each have the least
    /// sum if n grows with w^(2/3).
    void shareOut(std::span<PlaneTile> tiles, const Tile& texels) const {
        if (tiles.empty()) return;
        if (tiles.size() == 1) {
            tiles.front().texels = texels;
            return;
        }
        const auto claim = [&](std::span<const PlaneTile> some) {
            double sum = 0;
            for (const PlaneTile& tile : some) {
                const glm::dvec2 w = weight(tile);
                sum += std::pow(w.x + w.y, 2.0 / 3);
            }
            return sum;
        };
        const std::span<PlaneTile> low = tiles.first(tiles.size() / 2), high = tiles.subspan(tiles.size() / 2);
        const int axis = texels.size.x >= texels.size.y ? 0 : 1;
        const auto [first, second] = cutTexels(texels, axis, claim(low), claim(high));
        shareOut(low, first);
        shareOut(high, second);
    }

    /// `texels` cut along `axis` in the ratio low : high.
    static std::pair<Tile, Tile> cutTexels(const Tile& texels, int axis, double low, double high) {
        const int all = texels.size[axis];
        const double share = low + high > 0 ? low / (low + high) : 0.5;
        const int least = std::min(leastTexels, all / 2);
        const int first = std::clamp(static_cast<int>(std::lround(share * all)), least, all - least);
        std::pair<Tile, Tile> parts{texels, texels};
        parts.first.size[axis] = first;
        parts.second.at[axis] += first;
        parts.second.size[axis] -= first;
        return parts;
    }

    /// The tile cut after `cells` cells of `axis`: along it the errors w / n of n texels have the least sum if n grows with
    /// √w. Nothing if a part is empty.
    [[nodiscard]] std::optional<Cut> cutAt(const PlaneTile& tile, int axis, int cells) const {
        PlaneTile low = tile, high = tile;
        low.size[axis] = cells;
        high.at[axis] += cells;
        high.size[axis] -= cells;
        if (over(low).count <= 0 || over(high).count <= 0) return std::nullopt;
        low = narrowed(low);
        high = narrowed(high);
        std::tie(low.texels, high.texels) =
            cutTexels(tile.texels, axis, std::sqrt(weight(low)[axis]), std::sqrt(weight(high)[axis]));
        return Cut{expectedError(tile) - expectedError(low) - expectedError(high), {low, high}};
    }

    [[nodiscard]] std::optional<Cut> bestCut(const PlaneTile& tile) const {
        std::optional<Cut> best;
        for (int axis = 0; axis < 2; ++axis) {
            if (tile.texels.size[axis] < 2 * leastTexels) continue;
            for (int cells = 1; cells < tile.size[axis]; ++cells) {
                std::optional<Cut> cut = cutAt(tile, axis, cells);
                if (cut && cut->saved > (best ? best->saved : 0)) best = std::move(cut);
            }
        }
        return best;
    }

    int planes_, cells_;
    DemandSums sums_;
};

} // namespace

std::vector<PlaneTile> tilesFor(std::span<const Demand> demands, int planes, int cells, int side, int tiles) {
    return Tiling(demands, planes, cells).tiles(side, tiles);
}

} // namespace shadowbench::techniques
