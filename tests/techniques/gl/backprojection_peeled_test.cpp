// Back projection over depth-peeled layers: what the nearest layer hides from the light's centre.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "techniques/shared/maps/peeled_map.h"
#include "tests/support/soft_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const std::string everyTexel = ",window=all,samples=256,bits=256";

std::string layered(int layers) { return fmt::format("backprojection-peeled:layers={}{}", layers, everyTexel); }

double errorUnder(const std::vector<Strip>& strips, const std::string& variant) {
    const Scene scene = stripScene(strips);
    Stage stage(scene);
    stage.show(0);
    const auto points = stripPoints(stage, rendered(stage, variant), strips);
    return rmsErrorWhere(points, [](const SlabPoint& point) { return point.truth < 1; });
}

TEST(BackProjectionPeeled, TwoLayersHoldAPlateBelowAnother) {
    EXPECT_LT(errorUnder(hiddenStrip, layered(2)), 0.05);
    EXPECT_GT(errorUnder(hiddenStrip, layered(1)), 0.15); // one layer is a bitmask
}

TEST(BackProjectionPeeled, AsManyPlatesAsLayersAreHeld) {
    std::vector<Strip> three = hiddenStrip;
    three.push_back({0.7, -0.05, 0.25}); // seen from the light's centre, behind the other two
    EXPECT_GT(errorUnder(three, layered(2)), 0.07);
    EXPECT_LT(errorUnder(three, layered(3)), 0.05);
}

TEST(BackProjectionPeeled, ASurfaceThatGoesOnInTheNextLayerHasNoGap) {
    // The lower strip hides the light from x = 0.05 … 0.15; seen from the light's centre, it ends below the upper one.
    const std::vector<Strip> strips{{3, 0.19, 0.295}, {1.5, -0.2, 0.37}};
    const Scene scene = stripScene(strips);
    Stage stage(scene);
    stage.show(0);
    const auto two = stripPoints(stage, rendered(stage, layered(2)), strips);
    const auto one = stripPoints(stage, rendered(stage, layered(1)), strips);
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < two.size(); ++i) {
        if (std::abs(two[i].at.x - 0.1) > 0.05) continue;
        EXPECT_EQ(two[i].truth, 0);
        EXPECT_EQ(two[i].visibility, 0) << two[i].at.x;
        EXPECT_GT(one[i].visibility, 0.05);
        ++hidden;
    }
    EXPECT_GT(hidden, 20U);
}

TEST(BackProjectionPeeled, OneLayerIsABitmask) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, layered(1)), rendered(stage, "bitmask:window=all,samples=256,bits=256"));
    EXPECT_LT(penumbraRmsError(slabPoints(stage, rendered(stage, layered(2)))), 0.035);
}

TEST(BackProjectionPeeled, EachLayerCostsAPass) { // what it admits
    const Scene scene = boxScene(32);
    Scene lit = scene;
    lit.light = {LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    Stage stage(lit);
    stage.show(0);
    for (const int layers : {1, 2, 4}) {
        const techniques::Variant variant =
            techniques::parseVariant(fmt::format("backprojection-peeled:map=128,layers={}", layers));
        const auto technique = variant.entry->make(variant.parameters);
        int maps = 0;
        for (const timing::PassCost& pass : timing::measurePasses(stage, *technique, 0, 1, 1).passes)
            if (pass.name == "depth map" || pass.name == "depth peeling") {
                maps += pass.runs;
                EXPECT_EQ(pass.work.primitives, static_cast<std::uint64_t>(pass.runs) * snapshot(lit, 0).triangles());
            }
        EXPECT_EQ(maps, layers);
    }
}

TEST(BackProjectionPeeled, TheLayersOfAMapAreTheTopsOfTheCastersInOrder) {
    const Scene scene = stripScene(hiddenStrip, 16);
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    constexpr int side = 128;
    techniques::PeeledMap map(side, 4, {});
    const techniques::LightView view = techniques::fitToScene(scene.light, frame.snapshot);
    map.draw(view, frame);
    const Image<glm::vec4> texels = gl::RenderTarget({&map.texture()}).readVec4(0);
    const auto at = techniques::texelAt(view, {0.1, 0, 0.2}, glm::dvec2(side));
    ASSERT_TRUE(at);
    const glm::vec4 layers = texels(static_cast<int>(at->x), side - 1 - static_cast<int>(at->y));
    EXPECT_NEAR(layers.x, 6 - 3.002, 1e-4);
    EXPECT_NEAR(layers.y, 6 - 1.502, 1e-4);
    EXPECT_NEAR(layers.z, 6, 1e-4); // the slab's top
    EXPECT_EQ(layers.w, gl::nothingInTheWay);
}

TEST(BackProjectionPeeled, RefusesLayersThatAMapHasNoChannelFor) {
    EXPECT_THROW(techniques::parseVariant("backprojection-peeled:layers=5"), BadInput);
    EXPECT_THROW(techniques::parseVariant("backprojection-peeled:layers=0"), BadInput);
    EXPECT_THROW(techniques::parseVariant("backprojection-peeled:samples=256"), BadInput); // in 64 bits
}

} // namespace
} // namespace shadowbench
