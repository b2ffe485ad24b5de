// Frames as shaded pictures.
#include "harness/metrics/frames.h"
#include "harness/metrics/scores.h"
#include "tests/support/metrics_images.h"

#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

using namespace test;

/// Three pixels: a surface of one colour that faces the light, one turned by 60°, and background.
struct Three {
    Snapshot snapshot;
    Drawn drawn{Image<std::uint32_t>(3, 1, 1), Image<glm::vec3>(3, 1)};
    Image<glm::vec3> normals{3, 1, glm::vec3(0, 1, 0)};

    Three() {
        snapshot.light.kind = LightKind::Point;
        snapshot.light.centre = {0, 2, 0};
        snapshot.batches.push_back({nullptr, {1, 0.5F, 0.25F}, false, {{glm::dmat4(1), glm::dmat4(1), 1}}});
        normals(1, 0) = {std::sqrt(0.75F), 0.5F, 0};
        drawn.id(2, 0) = 0;
    }
};

TEST(ShadedPicture, OfALitPlaneThatFacesTheLightIsItsColourAndAFifthOfItInShadow) {
    const Three three;
    const Shading shades = shading(three.snapshot, three.drawn, three.normals);
    const auto shown = [&](float v, int x) { return shaded(shades, Image<float>(3, 1, v))(x, 0); };
    EXPECT_LT(glm::distance(shown(1, 0), glm::vec3(1, 0.5F, 0.25F)), 1e-6F);
    EXPECT_LT(glm::distance(shown(0, 0), 0.2F * glm::vec3(1, 0.5F, 0.25F)), 1e-6F);
    EXPECT_LT(glm::distance(shown(1, 1), (0.2F + 0.8F * 0.5F) * glm::vec3(1, 0.5F, 0.25F)), 1e-6F);
    EXPECT_EQ(shown(1, 2), glm::vec3(0)) << "background";
}

TEST(ShadedPicture, IsLitFromWhereTheLightStands) {
    Three three;
    three.drawn.position(0, 0) = {2 * std::sqrt(3.0F), 0, 0}; // 60° off the light
    EXPECT_NEAR(shading(three.snapshot, three.drawn, three.normals).direct(0, 0).x, 0.8 * 0.5, 1e-6);
}

TEST(ShadedPicture, IsLitFromADirectionAndNotFromBehind) {
    Three three;
    three.snapshot.light.kind = LightKind::Directional;
    three.snapshot.light.direction = {0, 1, 0};
    const Shading shades = shading(three.snapshot, three.drawn, three.normals);
    EXPECT_EQ(shades.direct(0, 0), glm::vec3(0));
    three.snapshot.light.direction = {0, -1, 0};
    EXPECT_FLOAT_EQ(shading(three.snapshot, three.drawn, three.normals).direct(0, 0).x, 0.8F);
}

/// A uniform plane: FLIP is that of two greys.
TEST(PictureFlip, ComparesWithTheTrueShadowsWithinTheMask) {
    const int size = 32;
    const auto truth = truthOf(size, size, [](glm::dvec2) { return 1.0; });
    const Shading shades{Image<glm::vec3>(size, size, glm::vec3(0.2F)), Image<glm::vec3>(size, size, glm::vec3(0.8F))};
    const FlipPicture lit = flipPicture(shaded(shades, truth.visibility));
    const auto flipOf = [&](const Image<float>& v, const Mask& mask) {
        return pictureFlip({{v, truth, mask}, shades, lit});
    };
    const Image<float> dark(size, size, 0);
    EXPECT_EQ(*flipOf(truth.visibility, everything(truth)), 0);
    EXPECT_FLOAT_EQ(static_cast<float>(*flipOf(dark, everything(truth))),
                    static_cast<float>(meanFlip(flipPicture(Image<glm::vec3>(size, size, glm::vec3(0.2F))), lit)));
    Mask none = everything(truth);
    none.scored = Image<std::uint8_t>(size, size, 0);
    none.count = 0;
    EXPECT_FALSE(flipOf(dark, none));
    none.scored(0, 0) = 1;
    none.count = 1;
    EXPECT_GT(*flipOf(dark, none), 0);
    EXPECT_LT(*flipOf(dark, none), 0.2 * *flipOf(dark, everything(truth))) << "the others have V*";
}

} // namespace
} // namespace shadowbench::metrics
