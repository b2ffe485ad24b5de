#include "groundtruth/cgal/area/area.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/cgal/area/area_exact.h"
#include "groundtruth/cgal/area/area_points.h"
#include "groundtruth/cgal/area/area_shape.h"
#include "groundtruth/cgal/area/area_sweep.h"
#include "groundtruth/cgal/area/area_weights.h"
#include "groundtruth/cgal/geometry/primary.h"

#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace shadowbench::groundtruth::area {
namespace {

/// What the fast form may err. Edges are first computed with the loosest tolerance; where the bound of the whole comes out
/// too large, again with a tighter one, the last of which makes all edges rational.
constexpr double wantedError = 1e-12;
constexpr std::array tolerances{0x1p-42, 0x1p-46, 0x1p-55};

constexpr VisibleFraction umbra{0, 0}, fullyLit{1, 1};

/// A fraction and the certain bound of its rounding, with the part of it that edges bring.
struct BoundedFraction {
    VisibleFraction fraction;
    double error, edgeError = 0;

    /// Edges that bring less than the rounding of the sum over thousands of them need not be exact.
    [[nodiscard]] bool isTightEnough() const { return error <= wantedError || 2 * edgeError <= error; }
};

/// What is smaller than the error is taken for nothing, so that abutting occluders leave no crack.
BoundedFraction areaFraction(const std::vector<CoverEdge>& edges, const LightShape& shape) {
    if (edges.empty()) return {fullyLit, 0};
    const SweptAreas swept = sweepAreas(edges, shape);
    const double error = swept.error / shape.area, edgeError = swept.edgeError / shape.area;
    if (swept.areas.outerVisible <= swept.error) return {umbra, 2 * error, 2 * edgeError};
    if (swept.areas.outerHidden <= swept.error) return {fullyLit, 2 * error, 2 * edgeError};
    return {enclosedFraction(swept.areas, shape), error, edgeError};
}

/// What hides the light, and the fraction that it leaves.
struct Hidden {
    std::vector<CoverEdge> edges;       // of a rectangle or disk
    std::vector<CoverInterval> parts{}; // of a line
    BoundedFraction left{};
};

BoundedFraction lengthFraction(const std::vector<CoverInterval>& hidden) {
    if (hidden.empty()) return {fullyLit, 0};
    const VisibleLength length = visibleLength(hidden);
    if (length.visible <= length.error) return {umbra, 2 * length.error, 2 * length.edgeError};
    if (1 - length.visible <= length.error) return {fullyLit, 2 * length.error, 2 * length.edgeError};
    return {{length.visible, length.visible}, length.error, length.edgeError};
}

void requireSize(const PrimaryHits& primary, glm::ivec2 size) {
    if (primary.id.width() != size.x || primary.id.height() != size.y)
        throw InternalError("Visible fractions were asked for an image size that is not that of the primary hits.");
}

/// What another share's sums may err: some thousand parts, each to 2⁻⁴⁶ of the whole
/// (groundtruth/cgal/area/area_weights.cpp).
constexpr double weightsError = 1e-10;

/// `found` by another share. What the areas' rounding leaves open weighs as much as where the weight is densest.
BoundedFraction weighed(const Hidden& found, Share share, const Light& light, const LightShape& shape,
                        const SurfacePoint& point) {
    const VisibleFraction& area = found.left.fraction;
    if (found.edges.empty()) return found.left;
    const LightWeights weights(light, point);
    const double error = found.left.error * weights.densest(share) + weightsError;
    if (area.low == 1 || area.high == 0) return {area, error};
    return {weighedFraction(found.edges, shape, weights, share), error};
}

} // namespace

struct AreaScene::Data {
    Camera camera;
    Light light;
    LightShape shape;
    std::shared_ptr<const SceneTriangles> triangles;
    int threads;

    [[nodiscard]] SurfacePoint surfacePoint(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary) const {
        requireSize(primary, size);
        if (!primary.id.contains(pixel.x, pixel.y) || primary.surface(pixel.x, pixel.y) != Surface::Receiver)
            throw InternalError("The visible fraction was asked for a pixel that sees no receiver.");
        const TriangleName receiver{triangles->instanceOf(primary.id(pixel.x, pixel.y)), primary.triangle(pixel.x, pixel.y)};
        return {pixelRay(camera, pixel.x, pixel.y, size), triangles->triangle(receiver)};
    }

    /// Nothing where the light is seen edge-on.
    [[nodiscard]] std::optional<Hidden> hidden(const SurfacePoint& point) const {
        std::optional<Hidden> found;
        for (const double tolerance : tolerances) {
            found = hidden(point, tolerance);
            if (!found || found->left.isTightEnough()) break;
        }
        return found;
    }

    [[nodiscard]] std::optional<Hidden> hidden(const SurfacePoint& point, double tolerance) const {
        if (light.kind == LightKind::Line) {
            auto parts = coverIntervals(*triangles, light, point, tolerance);
            if (!parts) return std::nullopt;
            const BoundedFraction left = lengthFraction(*parts);
            return Hidden{{}, std::move(*parts), left};
        }
        auto edges = coverEdges(*triangles, light, point, tolerance);
        if (!edges) return std::nullopt;
        const BoundedFraction left = areaFraction(*edges, shape);
        return Hidden{std::move(*edges), {}, left};
    }

    void requireShare(Share share) const {
        if (share != Share::Area && light.kind == LightKind::Line)
            throw InternalError("A share of irradiance or solid angle was asked for a line light.");
    }

    [[nodiscard]] std::optional<BoundedFraction> visible(const SurfacePoint& point, Share share) const {
        const std::optional<Hidden> found = hidden(point);
        if (!found) return std::nullopt;
        return share == Share::Area ? found->left : weighed(*found, share, light, shape, point);
    }
};

AreaScene::AreaScene(const Snapshot& snapshot, int threads)
    : AreaScene(snapshot, std::make_shared<const SceneTriangles>(snapshot), threads) {}

AreaScene::AreaScene(const Snapshot& snapshot, std::shared_ptr<const SceneTriangles> triangles, int threads) {
    if (!snapshot.light.isArea()) throw InternalError("Visible fractions were asked for a light without an area.");
    data_.reset(new Data{snapshot.camera, snapshot.light, lightShape(snapshot.light.kind), std::move(triangles), threads});
}

AreaScene::~AreaScene() = default;

VisibleFraction AreaScene::fraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary) const {
    return fraction(pixel, size, primary, Share::Area);
}

VisibleFraction AreaScene::fraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary, Share share) const {
    data_->requireShare(share);
    const auto found = data_->visible(data_->surfacePoint(pixel, size, primary), share);
    return found ? found->fraction : VisibleFraction{0, 1};
}

SampledFraction AreaScene::sampledFraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary,
                                           const LightPoints& points) const {
    const std::optional<Hidden> found = data_->hidden(data_->surfacePoint(pixel, size, primary));
    const std::vector<int> none(points.sizes().size(), 0);
    if (!found) return {{0, 1}, none};
    const VisibleFraction& fraction = found->left.fraction;
    if (fraction.low == 1) return {fraction, points.sizes()};
    if (fraction.high == 0) return {fraction, none};
    const bool line = data_->light.kind == LightKind::Line;
    return {fraction, line ? points.visible(found->parts) : points.visible(found->edges)};
}

VisibleFraction AreaScene::exactFraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary) const {
    const SurfacePoint point = data_->surfacePoint(pixel, size, primary);
    return exactVisibleFraction(areaCandidates(*data_->triangles, data_->light, point), data_->light, point);
}

void AreaScene::label(glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress,
                      Share share) const {
    requireSize(primary, size);
    data_->requireShare(share);
    out.visibility = Image<float>(size.x, size.y);
    out.sigma = Image<float>(size.x, size.y);
    out.surface = primary.surface;
    out.id = primary.id;
    out.position = primary.position;
    out.edgeDistance = Image<float>(size.x, size.y, std::numeric_limits<float>::infinity());
    inParallel(size.y, data_->threads, progress, "visible fractions", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != Surface::Receiver) continue;
            const auto found = data_->visible(data_->surfacePoint({x, y}, size, primary), share);
            if (!found) {
                out.surface(x, y) = Surface::OnEdge;
                continue;
            }
            const VisibleFraction& f = found->fraction;
            out.visibility(x, y) = static_cast<float>(0.5 * (f.low + f.high));
            out.sigma(x, y) = static_cast<float>(0.5 * (f.high - f.low) + found->error);
        }
    });
}

} // namespace shadowbench::groundtruth::area
