#include "scene/meshes/alpha_mask.h"

#include "base/error.h"
#include "base/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <vector>

namespace shadowbench {
namespace {

using Polygon = std::vector<glm::dvec2>; // convex, counter-clockwise, in texels

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

int wrapped(int texel, int size, AlphaMask::Wrap wrap) {
    if (wrap == AlphaMask::Wrap::Clamp) return std::clamp(texel, 0, size - 1);
    const int period = wrap == AlphaMask::Wrap::Mirror ? 2 * size : size;
    const int within = ((texel % period) + period) % period;
    return within < size ? within : period - 1 - within;
}

/// The cells of a mask: its texels where they are squares, else the squares between four texels' centres.
class Cells {
public:
    explicit Cells(const AlphaMask& mask) : mask_(mask) {}

    /// Where corners of cells are whole numbers.
    [[nodiscard]] glm::dvec2 place(const glm::vec2& uv) const {
        return glm::dvec2(uv) * glm::dvec2(mask_.alpha.width(), mask_.alpha.height()) - (mask_.nearest ? 0.0 : 0.5);
    }

    [[nodiscard]] bool solidAt(const glm::dvec2& place) const {
        const glm::ivec2 cell(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
        const glm::dvec2 in = mask_.nearest ? glm::dvec2(0) : place - glm::dvec2(cell);
        const std::array<double, 4> a = corners(cell);
        return (1 - in.y) * ((1 - in.x) * a[0] + in.x * a[1]) + in.y * ((1 - in.x) * a[3] + in.x * a[2]) >= 0;
    }

    [[nodiscard]] bool full(const glm::ivec2& cell) const {
        return mask_.nearest ? above(cell) >= 0 : std::ranges::min(corners(cell)) >= 0;
    }

    /// The solid parts of a cell that is not full.
    [[nodiscard]] std::vector<Polygon> parts(const glm::ivec2& cell) const {
        if (mask_.nearest) return {};
        const std::array<double, 4> a = corners(cell);
        if (std::ranges::max(a) < 0) return {};
        const bool opposite = (a[0] < 0) == (a[2] < 0) && (a[1] < 0) == (a[3] < 0) && (a[0] < 0) != (a[1] < 0);
        const bool joined = opposite && (a[0] * a[2] - a[1] * a[3]) / (a[0] + a[2] - a[1] - a[3]) >= 0;
        if (!opposite || joined) return {walked(cell, a, 0, 4)};
        const int first = a[0] < 0 ? 1 : 0;
        return {walked(cell, a, first + 3, 2), walked(cell, a, first + 1, 2)};
    }

private:
    [[nodiscard]] double above(const glm::ivec2& texel) const {
        return mask_.alpha(wrapped(texel.x, mask_.alpha.width(), mask_.u), wrapped(texel.y, mask_.alpha.height(), mask_.v)) -
               mask_.cutoff;
    }
    [[nodiscard]] std::array<double, 4> corners(const glm::ivec2& cell) const {
        return {above(cell), above(cell + glm::ivec2(1, 0)), above(cell + glm::ivec2(1, 1)), above(cell + glm::ivec2(0, 1))};
    }

    /// The solid corners and the crossings met on the way along `edges` of the four edges from the corner `first`.
    static Polygon walked(const glm::ivec2& cell, const std::array<double, 4>& a, int first, int edges) {
        constexpr std::array<glm::ivec2, 4> at{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        Polygon polygon;
        for (int i = first; i < first + edges; ++i) {
            const auto from = static_cast<std::size_t>(i % 4), to = static_cast<std::size_t>((i + 1) % 4);
            const glm::dvec2 begin(cell + at[from]), end(cell + at[to]);
            if (a[from] >= 0) polygon.push_back(begin);
            if ((a[from] < 0) != (a[to] < 0)) polygon.push_back(glm::mix(begin, end, a[from] / (a[from] - a[to])));
        }
        return polygon;
    }

    const AlphaMask& mask_;
};

/// The part of `polygon` to the left of the line from `from` to `to`.
Polygon leftOf(const Polygon& polygon, const glm::dvec2& from, const glm::dvec2& to) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double left = cross(to - from, a - from), next = cross(to - from, b - from);
        if (left >= 0) result.push_back(a);
        if ((left < 0) != (next < 0)) result.push_back(glm::mix(a, b, left / (left - next)));
    }
    return result;
}

/// One triangle of the mesh, and what is left of it.
class Cutter {
public:
    Cutter(const Mesh& mesh, std::span<const glm::vec2> uv, const Cells& cells, Mesh& left)
        : mesh_(mesh), uv_(uv), cells_(cells), left_(left) {}

    void cut(const glm::uvec3& triangle) {
        for (int corner = 0; corner < 3; ++corner) {
            texels_[corner] = cells_.place(uv_[triangle[corner]]);
            requireNear(texels_[corner]);
            positions_[corner] = glm::dvec3(mesh_.positions[triangle[corner]]);
        }
        const double area = cross(texels_[1] - texels_[0], texels_[2] - texels_[0]);
        if (area == 0) {
            const glm::dvec2 middle = (texels_[0] + texels_[1] + texels_[2]) / 3.0;
            if (cells_.solidAt(middle)) addFan(positions_);
            return;
        }
        turned_ = area < 0;
        toWeights_ = glm::inverse(glm::dmat2(texels_[1] - texels_[0], texels_[2] - texels_[0]));
        rows();
    }

private:
    static void requireNear(const glm::dvec2& texel) {
        constexpr double most = 1e9; // cells are counted by ints
        if (!(std::max(std::abs(texel.x), std::abs(texel.y)) < most))
            throw BadInput(fmt::format("a corner lies at texel ({:g}, {:g}) of its mask", texel.x, texel.y));
    }

    void rows() {
        const glm::dvec2 low = glm::min(texels_[0], glm::min(texels_[1], texels_[2])),
                         high = glm::max(texels_[0], glm::max(texels_[1], texels_[2]));
        const glm::dvec2 size = glm::ceil(high) - glm::floor(low);
        if (!(size.x * size.y <= static_cast<double>(limitOf(Limit::Triangles))))
            throw BadInput(fmt::format("a triangle covers {:.0f} × {:.0f} texels of its mask, {}", size.x, size.y,
                                       beyond(Limit::Triangles)));
        const glm::ivec2 first(glm::floor(low)), end(glm::ceil(high));
        for (glm::ivec2 cell(first); cell.y < end.y; ++cell.y)
            for (cell.x = first.x; cell.x < end.x; ++cell.x) {
                const int begin = cell.x;
                while (cell.x < end.x && cells_.full(cell)) ++cell.x;
                if (cell.x > begin) {
                    const double y = cell.y;
                    add({{begin, y}, {cell.x, y}, {cell.x, y + 1}, {begin, y + 1}});
                }
                if (cell.x < end.x)
                    for (const Polygon& part : cells_.parts(cell)) add(part);
            }
    }

    /// The part within the triangle.
    void add(Polygon polygon) {
        for (int i = 0; i < 3 && !polygon.empty(); ++i) {
            const glm::dvec2 &from = texels_[i], &to = texels_[(i + 1) % 3];
            polygon = turned_ ? leftOf(polygon, to, from) : leftOf(polygon, from, to);
        }
        std::vector<glm::dvec3> positions;
        for (const glm::dvec2& point : polygon) {
            const glm::dvec2 weights = toWeights_ * (point - texels_[0]);
            positions.push_back(positions_[0] + weights.x * (positions_[1] - positions_[0]) +
                                weights.y * (positions_[2] - positions_[0]));
        }
        if (turned_) std::ranges::reverse(positions);
        addFan(positions);
    }

    void addFan(std::span<const glm::dvec3> positions) {
        const auto first = static_cast<std::uint32_t>(left_.positions.size());
        for (const glm::dvec3& position : positions) left_.positions.emplace_back(position);
        for (std::uint32_t i = 2; i < positions.size(); ++i)
            if (const glm::uvec3 t(first, first + i - 1, first + i); hasArea(left_, t)) left_.triangles.push_back(t);
        if (left_.triangles.size() > limitOf(Limit::Triangles))
            throw BadInput(fmt::format("without the holes of its mask it has {} triangles, {}; mask_texels = 32 in a "
                                       "scene file takes a smaller mask",
                                       left_.triangles.size(), beyond(Limit::Triangles)));
    }

    const Mesh& mesh_;
    std::span<const glm::vec2> uv_;
    const Cells& cells_;
    Mesh& left_;
    std::array<glm::dvec2, 3> texels_;
    std::array<glm::dvec3, 3> positions_;
    bool turned_ = false; // the texture is mirrored
    glm::dmat2 toWeights_{1};
};

} // namespace

Mesh cutByMask(const MaskedMesh& cards) {
    const Cells cells(*cards.mask);
    Mesh left;
    Cutter cutter(cards.mesh, cards.uv, cells, left);
    for (const glm::uvec3& triangle : cards.mesh.triangles) cutter.cut(triangle);
    return left;
}

} // namespace shadowbench
