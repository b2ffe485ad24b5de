// The transfer of sRGB.
#include "base/srgb.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Srgb, IsUndoneByItself) {
    for (const float v : {0.0F, 0.001F, 0.0031308F, 0.2F, 0.5F, 1.0F})
        EXPECT_NEAR(linearFromSrgb(srgbFromLinear(v)), v, 1e-6);
    EXPECT_NEAR(srgbFromLinear(0.5F), 0.7354F, 1e-4);
    for (const float v : {-0.25F, 1.5F}) { // a shadow has no such value; it is refused where it matters
        EXPECT_EQ(srgbFromLinear(v), v);
        EXPECT_EQ(linearFromSrgb(v), v);
    }
}

TEST(ForScreen, IsSrgbOfEachColourWithinWhatAScreenShows) {
    const glm::vec3 shown = forScreen({0.5F, -1, 3});
    EXPECT_NEAR(shown.x, 0.7354F, 1e-4);
    EXPECT_EQ(shown.y, 0);
    EXPECT_FLOAT_EQ(shown.z, 1);
}

} // namespace
} // namespace shadowbench
