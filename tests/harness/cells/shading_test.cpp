// Visibility as a shaded picture.
#include "harness/cells/shading.h"

#include "base/srgb.h"
#include "base/temporary_folder.h"
#include "harness/cells/kept_images.h"
#include "scene/sky.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const glm::vec3 colour(0.8F, 0.5F, 0.25F);

/// Three pixels: two of a plane that faces up, the first below the light and the second where it stands 60° off; background.
struct Plane {
    Snapshot snapshot;
    metrics::Drawn drawn{Image<std::uint32_t>(3, 1, 1), Image<glm::vec3>(3, 1)};
    Image<glm::vec3> normals{3, 1, glm::vec3(0, 1, 0)};

    Plane() {
        snapshot.light.kind = LightKind::Point;
        snapshot.light.centre = {0, 2, 0};
        snapshot.batches.push_back({nullptr, colour, false, {{glm::dmat4(1), glm::dmat4(1), 1}}});
        drawn.position(1, 0) = {2 * std::sqrt(3.0F), 0, 0};
        drawn.id(2, 0) = 0;
    }

    [[nodiscard]] PictureShading shading() const { return pictureShading(snapshot, drawn, normals); }
};

glm::vec3 shown(const PictureShading& shading, float v, int x) {
    return shadedPicture(shading, Image<float>(3, 1, v))(x, 0);
}

void expectColour(const glm::vec3& shown, const glm::vec3& linear) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], srgbFromLinear(linear[i]), 1e-5) << i;
}

TEST(ShadedPicture, OfAPlaneUnderALightIsAmbientPlusVisibleCosine) {
    const PictureShading shading = Plane().shading();
    expectColour(shown(shading, 1, 0), colour);
    expectColour(shown(shading, 0.5F, 0), (0.2F + 0.5F * 0.8F) * colour);
    expectColour(shown(shading, 1, 1), (0.2F + 0.8F * 0.5F) * colour);
    expectColour(shown(shading, 0.25F, 1), (0.2F + 0.25F * 0.8F * 0.5F) * colour);
}

TEST(ShadedPicture, OfFullShadowIsItsAmbientPart) {
    const PictureShading shading = Plane().shading();
    for (const int x : {0, 1}) expectColour(shown(shading, 0, x), 0.2F * colour);
}

TEST(ShadedPicture, HasABackgroundThatNoShadowChanges) {
    const PictureShading shading = Plane().shading();
    EXPECT_EQ(shown(shading, 0, 2), shown(shading, 1, 2));
    EXPECT_NE(shown(shading, 0, 2), glm::vec3(0));
}

TEST(ShadedPicture, OfBlackIsBlack) {
    Plane plane;
    plane.snapshot.batches[0].colour = glm::vec3(0);
    EXPECT_EQ(shown(plane.shading(), 1, 0), glm::vec3(0));
}

TEST(ShadedPicture, UnderASkyHasTheIrradianceThatNothingHides) {
    Plane plane;
    plane.normals(1, 0) = glm::normalize(glm::vec3(1, 1, 0));
    plane.snapshot.light = environmentLight({ConstantSky{1}, {}});
    const PictureShading even = plane.shading();
    for (const int x : {0, 1}) EXPECT_NEAR(even.direct(x, 0), 4, 0.02) << "the same all around, whichever way it faces";

    plane.snapshot.light = environmentLight({ConstantSky{0}, {{{0, 1, 0}, 0.5, 1000}}});
    const PictureShading sunny = plane.shading();
    EXPECT_NEAR(sunny.direct(0, 0), 4, 1e-4);
    EXPECT_NEAR(sunny.direct(1, 0), 4 * std::sqrt(0.5), 1e-3);
}

TEST(KeptShading, IsReadAsItWasMade) {
    const TemporaryFolder folder;
    const auto file = shadingFile(folder.path(), "scene");
    EXPECT_FALSE(readShading(file));
    const PictureShading made = Plane().shading();
    keepShading(file, made);
    const auto read = readShading(file);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->ambient, made.ambient);
    EXPECT_EQ(read->direct, made.direct);
}

} // namespace
} // namespace shadowbench
