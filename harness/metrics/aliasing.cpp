#include "base/error.h"
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::metrics {
namespace {

constexpr double pixelStep = 1.0 / 1024;

/// A plane as the camera sees it: image positions to world points.
class SeenPlane {
public:
    SeenPlane(const Camera& camera, glm::ivec2 size, const glm::dvec3& point, const glm::dvec3& normal)
        : camera_(camera), size_(size), normal_(normal), distance_(glm::dot(normal, point - camera.eye)) {}

    /// Nothing where the plane is seen edge-on or from behind the eye.
    [[nodiscard]] std::optional<glm::dvec3> at(glm::dvec2 pixel) const {
        const glm::dvec3 ray = camera_.ray(pixel, size_);
        const double along = distance_ / glm::dot(normal_, ray);
        if (!std::isfinite(along) || along <= 0) return {};
        return camera_.eye + along * ray;
    }

private:
    const Camera& camera_;
    glm::ivec2 size_;
    glm::dvec3 normal_;
    double distance_;
};

/// Texels per pixel when the image position moves along `step`.
std::optional<glm::dvec2> slope(const SeenPlane& plane, glm::dvec2 centre, glm::dvec2 step, const MapPoint& mapPoint) {
    const auto texel = [&](glm::dvec2 pixel) -> std::optional<glm::dvec2> {
        const std::optional<glm::dvec3> world = plane.at(pixel);
        return world ? mapPoint(*world) : std::nullopt;
    };
    const std::optional<glm::dvec2> here = texel(centre);
    if (!here) return {};
    std::optional<glm::dvec2> least;
    for (const double side : {1.0, -1.0}) {
        const std::optional<glm::dvec2> there = texel(centre + side * step);
        if (!there) continue;
        const glm::dvec2 change = side * (*there - *here) / glm::length(step);
        if (!least || glm::length(change) < glm::length(*least)) least = change;
    }
    return least;
}

/// 1 over the smallest singular value of the matrix with columns `dx` and `dy`; nothing if that is 0.
std::optional<double> greatestStretch(glm::dvec2 dx, glm::dvec2 dy) {
    const double squares = glm::dot(dx, dx) + glm::dot(dy, dy);
    const double determinant = std::abs(dx.x * dy.y - dx.y * dy.x);
    const double greatest = 0.5 * (squares + std::sqrt(std::max(squares * squares - 4 * determinant * determinant, 0.0)));
    const double stretch = std::sqrt(greatest) / determinant; // σ₁ / (σ₁ σ₂)
    return std::isfinite(stretch) ? std::optional(stretch) : std::nullopt;
}

} // namespace

std::optional<Aliasing> aliasing(const MappedFrame& frame) {
    const auto& [camera, positions, normals, mask, mapPoint] = frame;
    if (!positions.sameSize(mask.scored) || !normals.sameSize(mask.scored))
        throw InternalError(
            "measuring aliasing on positions, normals and a mask of different sizes; render all at one size");
    const glm::ivec2 size(positions.width(), positions.height());
    std::vector<double> ratios;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            if (!mask.scored(x, y)) continue;
            const SeenPlane plane(camera, size, glm::dvec3(positions(x, y)), glm::dvec3(normals(x, y)));
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const std::optional<glm::dvec2> dx = slope(plane, centre, {pixelStep, 0}, mapPoint);
            const std::optional<glm::dvec2> dy = slope(plane, centre, {0, pixelStep}, mapPoint);
            if (!dx || !dy) continue;
            if (const std::optional<double> stretch = greatestStretch(*dx, *dy)) ratios.push_back(*stretch);
        }
    }
    if (ratios.empty()) return {};
    const double mapped = static_cast<double>(ratios.size()) / static_cast<double>(mask.count);
    return Aliasing{quantile(ratios, 0.5), quantile(ratios, 0.95), mapped};
}

} // namespace shadowbench::metrics
