// Soft shadow mapping by back projection against its closed forms, and its min/max pyramid against a model.
#include "base/error.h"
#include "techniques/shared/maps/linear_depth_map.h"
#include "techniques/shared/maps/min_max_pyramid.h"
#include "tests/support/shader_function.h"
#include "tests/support/tilted_light.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(BackProjection, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto points = slabPoints(stage, rendered(stage, "backprojection"));
    // The edge lies anywhere in a texel, of which the penumbra has 21: 1 / 21 / √12, and as much again for depths and rows.
    EXPECT_LT(penumbraRmsError(points), 0.025);
    EXPECT_NEAR(visibilityAt(points, hardEdge), 0.5, 0.03);
    EXPECT_GT(visibilityAt(points, litUntil - 0.1), 0.999);
    EXPECT_LT(visibilityAt(points, umbraFrom + 0.1), 0.001);
}

TEST(BackProjection, ASlantedReceiverIsLitButForThePenumbraOfTheEdge) {
    const Scene scene = tiltedLightScene(30);
    Stage stage(scene);
    stage.show(0);
    const auto points = tiltedLightPoints(stage, rendered(stage, "backprojection"));
    EXPECT_LT(penumbraRmsError(points), 0.025); // as under a level light: the penumbra has as many texels
    for (const SlabPoint& point : points) {
        if (point.truth > 0 && point.truth < 1) continue;
        EXPECT_NEAR(point.visibility, point.truth, 0.05) << point.at.x; // a column of texels at the edge
    }
}

TEST(BackProjection, TexelsAreClippedToTheLight) {
    const std::vector<glm::vec4> rectangles{{-1, -1, 1, 1}, {-3, -2, 5, 4},     {0, 0, 1, 1},        {-0.5, 0.5, 0.25, 3},
                                            {1, -1, 2, 1},  {0.5, 0.5, 0.2, 1}, {-2, -0.2, -1.5, 1}, {0.9, -5, 7, -0.6}};
    const auto shares = evaluated("soft/backprojection/texel_quad.glsl", "shareOfLight(x.xy, x.zw)", rectangles);
    const auto side = [](double low, double high) { return std::max(0.0, std::min(high, 1.0) - std::max(low, -1.0)); };
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        const glm::dvec4 r(rectangles[i]);
        EXPECT_NEAR(shares[i].x, side(r.x, r.z) * side(r.y, r.w) / 4, 1e-6) << i;
    }
}

TEST(BackProjection, OccludersThatOverlapOnTheLightCountTwice) { // what the papers admit, Fig. 2.22
    const Scene scene = stripScene(touchingStrips);
    Stage stage(scene);
    stage.show(0);
    std::size_t overlapping = 0;
    double most = 0;
    for (const SlabPoint& point : stripPoints(stage, rendered(stage, "backprojection"), touchingStrips)) {
        const double delta = hiddenBy(touchingStrips, scene.light, point.at).overlap();
        if (delta < 0.05) continue;
        // Four edges of which each lies anywhere in a texel: up to 1/45 of the light for the upper strip's, 1/85 for the
        // lower's.
        EXPECT_NEAR(point.truth - point.visibility, delta, 0.05);
        most = std::max(most, delta);
        ++overlapping;
    }
    EXPECT_GT(overlapping, 50U);
    EXPECT_GT(most, 0.2);
}

TEST(BackProjection, LightBetweenOccludersThatOnlySeemToTouchIsLost) { // the other side of filling gaps
    const Scene scene = stripScene(touchingStrips);
    Stage stage(scene);
    stage.show(0);
    const auto filled = stripPoints(stage, rendered(stage, "backprojection"), touchingStrips);
    const auto left = stripPoints(stage, rendered(stage, "backprojection:gaps=leave"), touchingStrips);
    std::size_t apart = 0;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        const double x = filled[i].at.x;
        if (x > 0.02 || x < -0.05) continue; // a gap between the strips, all of it before the light
        const double upper = x + (0.1 - x) * 6 / 3, lower = x + (0.1 - x) * 6 / 1.5;
        EXPECT_NEAR(filled[i].truth - filled[i].visibility, (lower - upper) / 1.5, 0.05);
        EXPECT_NEAR(left[i].truth, left[i].visibility, 0.05);
        ++apart;
    }
    EXPECT_GT(apart, 30U);
}

TEST(BackProjection, ACasterThatTheLightsCentreDoesNotSeeDoesNotOcclude) { // one layer
    const Scene scene = stripScene(hiddenStrip);
    Stage stage(scene);
    stage.show(0);
    const auto points = stripPoints(stage, rendered(stage, "backprojection"), hiddenStrip);
    const double hidden = hiddenBy({hiddenStrip[0]}, scene.light, {0.1, 0, 0}).once;
    EXPECT_NEAR(visibilityAt(points, 0.1), 1 - hidden, 0.04); // quads of up to 1/32 of the light, half a one at each edge
    EXPECT_GT(1 - hidden - (1 - hiddenBy(hiddenStrip, scene.light, {0.1, 0, 0}).once), 0.3);
}

TEST(BackProjection, GapsBetweenTexelsOfASlantedOccluderAreFilled) {
    const Scene scene = fallingPlateScene();
    Stage stage(scene);
    stage.show(0);
    // The texels' images drift apart by (x / z0) tan 55° of their size at x on the light, 4 m above the edge: of the half of
    // the light that is hidden at the hard edge, tan 55° · 0.75 / 2 / 4 is missing.
    const double missing = 0.5 * std::tan(glm::radians(55.0)) * 0.75 / 2 / 4;
    const auto filled = slabPoints(stage, rendered(stage, "backprojection"));
    const auto left = slabPoints(stage, rendered(stage, "backprojection:gaps=leave"));
    EXPECT_NEAR(visibilityAt(filled, hardEdge), 0.5, 0.025);
    EXPECT_NEAR(visibilityAt(left, hardEdge), 0.5 + missing, 0.025);
    EXPECT_GT(missing, 0.06);
}

double quadsOf(Stage& stage, const std::string& variant) { return figuresOf(stage, variant).at("quads"); }

TEST(BackProjection, SquaresOfOneDepthAreOneQuad) {
    const Scene level = halfPlaneScene(), falling = fallingPlateScene();
    Stage stage(level), slanted(falling);
    stage.show(0);
    slanted.show(0);
    // Half as large texels are four times as many, but only twice as many along the plate's edge.
    const std::string many = "backprojection:flat=0,texels=128", few = many + ",map=512";
    EXPECT_LT(quadsOf(stage, many), 2.5 * quadsOf(stage, few));
    EXPECT_GT(quadsOf(slanted, many), 3 * quadsOf(slanted, few));

    const std::string merged = "backprojection:texels=128";
    EXPECT_LT(quadsOf(slanted, merged), 0.9 * quadsOf(slanted, many));
    const Image<float> one = rendered(slanted, merged), other = rendered(slanted, many);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], 0.02); // of the light's half side
}

TEST(BackProjection, TheSearchAreaIsLimitedByLeavingTexelsOut) {
    const Scene scene = fallingPlateScene();
    Stage stage(scene);
    stage.show(0);
    const std::string all = "backprojection:flat=0,map=2048,texels=128", some = "backprojection:flat=0,map=2048,texels=64";
    EXPECT_NEAR(quadsOf(stage, some) / quadsOf(stage, all), 0.25, 0.06); // every second texel along x and y
    EXPECT_LT(penumbraRmsError(slabPoints(stage, rendered(stage, some))), 0.025);
}

TEST(BackProjection, RefusesWhatItHasNoAnswerFor) {
    EXPECT_THROW(techniques::parseVariant("backprojection:gaps=maybe"), BadInput);
    EXPECT_THROW(techniques::parseVariant("backprojection:flat=2"), BadInput);
    Scene scene = halfPlaneScene();
    const techniques::Entry& entry = techniques::entryNamed("backprojection");
    EXPECT_FALSE(entry.notApplicable(scene));
    scene.light.kind = LightKind::Disk;
    EXPECT_EQ(entry.notApplicable(scene), "clips the texels' images to a rectangular light; the light of test is a disk");
}

/// Greatest and least 1 / depth of the texels of a node, `ends` of them per side beside its own.
std::array<float, 2> rangeOf(const Image<float>& depths, int level, glm::ivec2 node, int ends) {
    std::array<float, 2> range{0, 1e30F};
    const glm::ivec2 low = node << level, high = low + (1 << level) + ends;
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            const bool beside = x >= depths.width() || y >= depths.height();
            const float inverse = beside ? 0 : 1 / std::abs(depths(x, depths.height() - 1 - y)); // row 0 at the top
            range = {std::max(range[0], inverse), std::min(range[1], inverse)};
        }
    return range;
}

TEST(MinMaxPyramid, BoundsTheDepthsOfEachNode) {
    const Scene scene = halfPlaneScene(16);
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    constexpr int side = 50; // rounded up to 64: some nodes lie beside the map
    techniques::LinearDepthMap map(side, {});
    map.draw(techniques::fitToScene(scene.light, frame.snapshot), frame);
    const Image<float> depths = gl::RenderTarget({&map.texture()}).readFloat(0);
    using techniques::NodeEnds;
    for (const auto& [kind, ends] : {std::pair(NodeEnds::Apart, 0), std::pair(NodeEnds::Shared, 1)}) {
        techniques::MinMaxPyramid pyramid(side, kind);
        pyramid.draw(map.texture(), frame);
        EXPECT_EQ(pyramid.levels(), 6);
        for (int level = 1; level <= pyramid.levels(); ++level) {
            const Image<glm::vec4> nodes = gl::RenderTarget({&pyramid.level(level)}).readVec4(0);
            EXPECT_EQ(nodes.width(), 64 >> level);
            for (int y = 0; y < nodes.height(); ++y)
                for (int x = 0; x < nodes.width(); ++x) {
                    const glm::vec4 node = nodes(x, nodes.height() - 1 - y);
                    const auto range = rangeOf(depths, level, {x, y}, ends);
                    EXPECT_NEAR(node.x, range[0], 1e-6) << level << " " << x << " " << y;
                    EXPECT_NEAR(node.y, range[1], 1e-6) << level << " " << x << " " << y;
                }
        }
    }
}

} // namespace
} // namespace shadowbench
