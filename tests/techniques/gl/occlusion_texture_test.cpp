// Occlusion textures against their closed forms, their slices and their summed areas.
#include "base/error.h"
#include "techniques/shared/filters/occluder_layers.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "tests/support/plate_scenes.h"
#include "tests/support/shader_function.h"

#include <random>

namespace shadowbench {
namespace {

using techniques::LightView;
using techniques::OccluderLayers;

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = "occlusion-texture:map=1024") {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

TEST(OcclusionTexture, ThePenumbraUnderAHalfPlaneIsARamp) {
    EXPECT_LT(penumbraRmsError(pointsOf(halfPlaneScene())), 0.05); // a slice's thickness, besides the texels
}

TEST(OcclusionTexture, PlatesWithOneEdgeDarkenTwice) { // the product takes slices for independent
    Scene scene = halfPlaneScene();
    scene.objects.push_back(plate(3, edgeFor(3, hardEdge)));
    const std::vector<SlabPoint> points = pointsOf(scene);
    EXPECT_NEAR(visibilityAt(points, hardEdge), 0.25, 0.03); // half the light is visible past either, and past both
}

TEST(OcclusionTexture, WithoutASliceBetweenThereIsNoShadow) { // contact is as thin as slices are thick
    const Scene scene = halfPlaneAt(0.3);                     // umbra from 4 cm behind the hard edge
    const double umbra = 0.5;
    // The slab's top lies a quarter of the way into the second of two slices, and so counts a quarter of the first.
    EXPECT_GT(visibilityAt(pointsOf(scene, "occlusion-texture:map=1024,slices=2"), umbra), 0.7);
    EXPECT_LT(visibilityAt(pointsOf(scene), umbra), 0.01);
}

/// The layers of the plates' scene as the technique draws them.
class Slices : public testing::Test {
protected:
    Slices() {
        scene_ = halfPlaneScene();
        scene_.objects.push_back(object(box({1, 0.002, 1}), {-1, 4.001, 0.8}));
        scene_.objects.push_back(object(box({1, 0.002, 3}), {-3.5, 1.001, -1.5}));
        stage_.emplace(scene_);
        stage_->show(0);
        const techniques::Frame frame = stage_->frame(0, 1);
        view_ = techniques::fitToScene(scene_.light, frame.snapshot);
        layers_.emplace(side, gl::Program("shared/maps/linear_depth_map.vert", "soft/occlusion-texture/slices.frag"));
        thickness_ = (1 / view_.near - 1 / view_.far) / slices;
        layers_->program()
            .set("inverseRange", techniques::inverseRange(view_))
            .set("thickness", static_cast<float>(thickness_))
            .set("slices", slices);
        layers_->draw(view_, frame, std::vector<bool>(4, true), "slices");
        layers_->sum(frame, slices);
    }

    /// The bits where a world point lies in the map.
    [[nodiscard]] unsigned bitsAt(const glm::dvec3& world) const {
        const glm::dvec2 at = *techniques::texelAt(view_, world, glm::dvec2(side));
        const Image<unsigned> bits = gl::RenderTarget({&layers_->bits()}).readUint(0);
        return bits(static_cast<int>(at.x), side - 1 - static_cast<int>(at.y));
    }

    /// That of a depth below the light.
    [[nodiscard]] unsigned sliceOf(double depth) const {
        return 1U << static_cast<unsigned>((1 / view_.near - 1 / depth) / thickness_);
    }

    static constexpr int side = 256, slices = 16;
    Scene scene_;
    std::optional<Stage> stage_;
    LightView view_;
    std::optional<OccluderLayers> layers_;
    double thickness_ = 0;
};

TEST_F(Slices, OfOnePassHoldEverythingThatATexelsRayMeets) {
    const unsigned slab = sliceOf(6) | sliceOf(6.2);
    EXPECT_EQ(bitsAt({0, 0, 0}), slab);
    EXPECT_EQ(bitsAt({0.5, 2, 0}), sliceOf(4) | slab);
    EXPECT_EQ(bitsAt({-1, 4, 0.8}), sliceOf(2) | slab);
    EXPECT_EQ(bitsAt({-3.5, 1, -1.5}), sliceOf(5) | slab);
    EXPECT_NE(sliceOf(4), sliceOf(5));
}

TEST_F(Slices, AreAveragedOverAnyBox) {
    const Image<unsigned> bits = gl::RenderTarget({&layers_->bits()}).readUint(0);
    const glm::dvec2 halfLight = 0.75 / (view_.span / static_cast<double>(side)); // texels per 1/b − 1/r
    const auto mean = [&](unsigned slice, const glm::dvec2& at, double reach) {
        const glm::dvec2 middle = at * static_cast<double>(side), half = glm::max(reach * halfLight, glm::dvec2(0.5));
        const auto part = [&](int texel, int axis) { // of a texel that lies in the box along an axis
            return std::max(0.0, std::min(texel + 1.0, middle[axis] + half[axis]) -
                                     std::max<double>(texel, middle[axis] - half[axis]));
        };
        double sum = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                if ((bits(x, side - 1 - y) & slice) != 0) sum += part(x, 0) * part(y, 1);
        return sum / (4 * half.x * half.y);
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec4> places;
    for (int i = 0; i < 60; ++i) places.emplace_back(unit(random), unit(random), 0.2F * unit(random) * unit(random), 0);
    const auto slice = static_cast<unsigned>(std::countr_zero(sliceOf(4)));
    const auto read = evaluated("shared/filters/occluder_layers.glsl",
                                "occlusion(" + std::to_string(slice) + ", x.xy, x.z), 0.0, 0.0, 0.0", places, {},
                                [&](gl::Program& program) { layers_->bindTo(program, scene_.light, view_); });
    double most = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double expected = mean(1U << slice, glm::dvec2(places[i]), places[i].z);
        EXPECT_NEAR(read[i].x, expected, 1e-3) << places[i].x << " " << places[i].y << " " << places[i].z;
        most = std::max(most, std::min(expected, 1 - expected));
    }
    EXPECT_GT(most, 0.2); // some are at the edge
}

TEST(OcclusionTexture, RefusesMoreSlicesThanATexelHasBits) {
    EXPECT_THROW(techniques::parseVariant("occlusion-texture:slices=33"), BadInput);
    EXPECT_THROW(techniques::parseVariant("occlusion-texture:slices=0"), BadInput);
}

} // namespace
} // namespace shadowbench
