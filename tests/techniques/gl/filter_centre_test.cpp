// Filters are centred: an edge that lies between two texels is half lit there, and its shadow is the same from all sides.
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/filtered_scenes.h"

#include <array>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// A slab under a plate whose edge is a line through the middle, the plate towards `side`, a unit vector along x or z of
/// the world. The map is centred on the middle, so that the edge lies between two of its texels.
Scene edgeTowards(const glm::dvec2& side) {
    Scene scene = edgeScene(2);
    const glm::dvec3 to(side.x, 0, side.y), along(side.y, 0, side.x);
    scene.camera = {6.0 * along + glm::dvec3(0, 0.9, 0), {0, 0, 0}, {0, 1, 0}, 20, 0.5, 40};
    const glm::dvec3 size = glm::dvec3(12, 0.1, 12) - 6.0 * glm::abs(to);
    scene.objects.back() = object(box(size), 3.0 * to + glm::dvec3(0, 2.05, 0));
    return scene;
}

/// The greatest difference from a ramp of `width` metres around the middle, lit on the side away from the plate.
double fromCentredRamp(const std::string& variant, const glm::dvec2& side, double width) {
    const Scene scene = edgeTowards(side);
    Stage stage(scene);
    stage.show(0);
    double worst = 0;
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant))) {
        const double towards = glm::dot(glm::dvec2(point.at.x, point.at.z), side);
        worst = std::max(worst, std::abs(point.visibility - std::clamp(0.5 - towards / width, 0.0, 1.0)));
    }
    return worst;
}

class CentredFilter : public testing::TestWithParam<const char*> {};

TEST_P(CentredFilter, LeavesAnEdgeInItsPlaceFromAllSides) {
    constexpr int map = 256;
    constexpr std::array<glm::dvec2, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const int kernel : {3, 7})
        for (const glm::dvec2& side : sides) {
            const std::string variant = std::string(GetParam()) + ":map=256,kernel=" + std::to_string(kernel);
            const double texel = texelOf(edgeTowards(side), map - 2 * techniques::freeRim(techniques::boxFilter(kernel)));
            // Half a texel to a side would be 1 / (2 kernel).
            EXPECT_LT(fromCentredRamp(variant, side, kernel * texel), 0.25 / kernel)
                << variant << ", plate towards " << side.x << ", " << side.y;
        }
}

INSTANTIATE_TEST_SUITE_P(Maps, CentredFilter, testing::Values("vsm", "lvsm", "esm"),
                         [](const auto& test) { return std::string(test.param); });

} // namespace
} // namespace shadowbench
