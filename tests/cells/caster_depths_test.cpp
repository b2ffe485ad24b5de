// No texel of a shadow map is nearer to the light than all that lies within it, on any scene with an area light: one that is
// would be what min/max pyramids bound all searches with.
#include "scene/load/load.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "techniques/shared/maps/min_max_pyramid.h"
#include "techniques/shared/maps/peeled_map.h"
#include "tests/support/cell_stage.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using techniques::LightView;

std::vector<std::string> scenesWithAreaLights() {
    std::vector<std::string> ids;
    for (const std::string& id : builtinScenes())
        if (loadScene(id, Profile::Gate).light.isArea()) ids.push_back(id);
    return ids;
}

/// A point of the map, in texels, and the 1 / depth of what lies there, which is linear over the map on planes.
using Seen = glm::dvec3;

/// A triangle of which a near plane and the four sides of a texel cut a corner each. Millions are made.
template <typename Point>
using Polygon = boost::container::static_vector<Point, 3 + 1 + 4>;

/// The part of a convex polygon on the side of a line that `inside` ≥ 0 says.
template <typename Point, typename Inside>
Polygon<Point> cut(const Polygon<Point>& polygon, Inside inside) {
    Polygon<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = inside(from), b = inside(to);
        if (a >= 0) kept.push_back(from);
        if (a * b < 0) kept.push_back(from + a / (a - b) * (to - from));
    }
    return kept;
}

/// The part of it between two coordinates along an axis.
Polygon<Seen> between(const Polygon<Seen>& polygon, int axis, double low, double high) {
    return cut(cut(polygon, [&](const Seen& p) { return p[axis] - low; }), [&](const Seen& p) { return high - p[axis]; });
}

/// Greatest 1 / depth of all that lies within a texel or on its rim, for each of side² texels, row 0 at the top. In double
/// precision and without a rasteriser.
class NearestInTexels {
public:
    NearestInTexels(const LightView& view, const Snapshot& snapshot, int side) : side_(side), nearest_(side, side, 0.0) {
        for (const Batch& batch : snapshot.batches)
            for (const Placement& placement : batch.placements) {
                const glm::dmat4 clipFromObject = view.clipFromWorld * placement.world;
                for (const glm::uvec3& triangle : batch.mesh->triangles) {
                    Polygon<glm::dvec4> corners;
                    for (int i = 0; i < 3; ++i)
                        corners.push_back(clipFromObject * glm::dvec4(batch.mesh->positions[triangle[i]], 1));
                    add(cut(corners, [&](const glm::dvec4& h) { return h.w - 1e-4 * view.far; })); // as casters are cut
                }
            }
    }

    [[nodiscard]] double operator[](std::size_t texel) const { return nearest_[texel]; }

private:
    static constexpr double rim = 1.0 / 64; // of a texel: four steps of the rasteriser's grid

    void add(const Polygon<glm::dvec4>& corners) {
        Polygon<Seen> polygon;
        for (const glm::dvec4& h : corners)
            polygon.emplace_back((0.5 * glm::dvec2(h) / h.w + 0.5) * static_cast<double>(side_), 1 / h.w);
        eachCell(polygon, 1, [&](const Polygon<Seen>& strip, int row) {
            eachCell(strip, 0, [&](const Polygon<Seen>& part, int column) {
                double& nearest = nearest_(column, side_ - 1 - row);
                for (const Seen& p : part) nearest = std::max(nearest, p.z);
            });
        });
    }

    template <typename Action>
    void eachCell(const Polygon<Seen>& polygon, int axis, Action action) const {
        if (polygon.empty()) return;
        const auto less = [axis](const Seen& a, const Seen& b) { return a[axis] < b[axis]; };
        const auto [low, high] = std::ranges::minmax_element(polygon, less);
        const double last = side_ - 1;
        const int first = static_cast<int>(std::clamp((*low)[axis] - 1, 0.0, last));
        for (int i = first; i <= static_cast<int>(std::clamp((*high)[axis] + 1, 0.0, last)); ++i)
            if (const auto part = between(polygon, axis, i - rim, i + 1 + rim); !part.empty()) action(part, i);
    }

    int side_;
    Image<double> nearest_;
};

/// 1 / depth of what a map from a point stores as window depth.
double inverseOf(double windowDepth, const LightView& view) {
    return 1 / view.near - windowDepth * (1 / view.near - 1 / view.far);
}

class SceneWithAnAreaLight : public testing::TestWithParam<std::string> {
protected:
    SceneWithAnAreaLight() {
        testContext(); // outlives the stage
        Scene scene = loadScene(GetParam(), Profile::Gate);
        scene.size = {16, 16};
        stage_.emplace(scene);
        stage_->show(0);
        frame_.emplace(stage_->frame(0, 1));
        view_ = techniques::fitToScene(frame_->snapshot.light, frame_->snapshot);
    }

    /// Whether 1 / depth of every texel is that of something within it, held between far and near plane, or less.
    template <typename Inverse>
    void expectBehindWhatTexelsHold(const NearestInTexels& nearest, std::size_t texels, Inverse inverse, const char* map) {
        constexpr double rounding = 5e-7; // four steps of a 32-bit float near 1
        std::size_t before = 0;
        for (std::size_t i = 0; i < texels; ++i)
            if (inverse(i) > std::clamp(nearest[i], 1 / view_.far, 1 / view_.near) + rounding / view_.near) ++before;
        EXPECT_EQ(before, 0U) << map;
    }

    std::optional<Stage> stage_;
    std::optional<techniques::Frame> frame_;
    LightView view_;
};

TEST_P(SceneWithAnAreaLight, HasMapsInWhichNoTexelIsNearerThanWhatItHolds) {
    for (const int side : {512, 1500}) {
        const NearestInTexels nearest(view_, frame_->snapshot, side);
        techniques::LinearDepthMap linear(side, {});
        linear.draw(view_, *frame_);
        const Image<float> depths = gl::RenderTarget({&linear.texture()}).readFloat(0);
        expectBehindWhatTexelsHold(
            nearest, depths.size(), [&](std::size_t i) { return 1 / std::abs(depths[i]); }, "linear depths");

        techniques::MinMaxPyramid pyramid(side, techniques::NodeEnds::Apart);
        pyramid.draw(linear.texture(), *frame_);
        const Image<glm::vec4> top = gl::RenderTarget({&pyramid.level(pyramid.levels())}).readVec4(0);
        EXPECT_LE(top[0].x, (1 + 1e-6) / view_.near);

        techniques::PeeledMap peeled(side, 2, {});
        peeled.draw(view_, *frame_);
        const Image<glm::vec4> layers = gl::RenderTarget({&peeled.texture()}).readVec4(0);
        expectBehindWhatTexelsHold(
            nearest, layers.size(), [&](std::size_t i) { return 1 / std::abs(layers[i].x); }, "peeled layers");

        techniques::DepthMap window(side, {}, techniques::Lookup::Raw);
        window.draw(view_, *frame_);
        const Image<float> windows = gl::RenderTarget({&window.texture()}).readDepth();
        expectBehindWhatTexelsHold(
            nearest, windows.size(), [&](std::size_t i) { return inverseOf(windows[i], view_); }, "window depths");
    }
}

INSTANTIATE_TEST_SUITE_P(Gate, SceneWithAnAreaLight, testing::ValuesIn(scenesWithAreaLights()), nameOfText);

// The left side of the ground lies in a plane with the light's centre: at some sizes of the map it covers texels.
TEST(SoftContact, MapsOfAnySizeBoundTheSearchForMicroquads) {
    CellScene& scene = stillScene("soft-contact");
    for (const char* technique : {"bitmask", "backprojection", "backprojection-peeled"})
        for (const int side : {512, 1000, 1024, 1500, 2048}) {
            const double rmse = *scene.scored(fmt::format("{}:map={}", technique, side)).values["accuracy.rmse"];
            EXPECT_LE(rmse, side == 512 ? 0.045 : 0.03) << technique << " " << side; // squares of texels are larger at 512
        }
}

} // namespace
} // namespace shadowbench
