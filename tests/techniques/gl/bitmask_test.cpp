// Bitmask soft shadows: light samples that microquads hide, against closed forms.
#include "base/error.h"
#include "techniques/shared/sampling/light_samples.h"
#include "tests/support/shader_function.h"
#include "tests/support/tilted_light.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

const std::string small = "bitmask", large = "bitmask:window=12,samples=256,bits=256",
                  all = "bitmask:window=all,samples=256,bits=256";

double halfPlaneError(Stage& stage, const std::string& variant) {
    return penumbraRmsError(slabPoints(stage, rendered(stage, variant)));
}

TEST(Bitmask, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // A microquad needs all four corners: of the penumbra's 21 texels, half a one is missing.
    EXPECT_LT(halfPlaneError(stage, all), 0.035);
    EXPECT_LT(halfPlaneError(stage, large), 0.06); // squares of two texels
}

TEST(Bitmask, ASlantedReceiverIsLitButForThePenumbraOfTheEdge) {
    const Scene scene = tiltedLightScene(30);
    Stage stage(scene);
    stage.show(0);
    const auto points = tiltedLightPoints(stage, rendered(stage, all));
    EXPECT_LT(penumbraRmsError(points), 0.035); // as under a level light: the penumbra has as many texels
    for (const SlabPoint& point : points) {
        if (point.truth > 0 && point.truth < 1) continue;
        EXPECT_NEAR(point.visibility, point.truth, 0.05) << point.at.x; // a column of texels at the edge
    }
}

TEST(Bitmask, TheSmallWindowIsHalfASquareOffAtMost) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    // All receivers see the edge at the same place of a square of four texels, which the map's side decides: up to two and a
    // half of 21 texels off; in the mean over such places, less than the 0.09 of a search area cut into just eight squares.
    double sum = 0;
    const std::vector<int> sides{960, 1000, 1024, 1060, 1090};
    for (const int side : sides) {
        const double error = halfPlaneError(stage, fmt::format("bitmask:map={}", side));
        EXPECT_LT(error, 2.5 / 20) << side;
        sum += error * error;
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(sides.size())), 0.09);
}

TEST(Bitmask, SamplesAreOneInEachCellAndNoTwoInOneColumnOrRow) {
    for (const int side : {4, 8, 16}) {
        const std::vector<glm::vec2> points = techniques::lightSamples(side);
        const int strata = side * side;
        std::set<int> columns, rows;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec2 unit = 0.5 * glm::dvec2(points[i]) + 0.5;
            const glm::dvec2 place = unit * static_cast<double>(strata) - 0.5;
            EXPECT_NEAR(place.x, std::round(place.x), 1e-3);
            EXPECT_NEAR(place.y, std::round(place.y), 1e-3);
            columns.insert(static_cast<int>(std::lround(place.x)));
            rows.insert(static_cast<int>(std::lround(place.y)));
            EXPECT_EQ(static_cast<int>(unit.x * side), static_cast<int>(i) % side);
            EXPECT_EQ(static_cast<int>(unit.y * side), static_cast<int>(i) / side);
        }
        EXPECT_EQ(columns.size(), static_cast<std::size_t>(strata));
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(strata));
    }
}

/// The corners of a test's quad: a parallelogram around `p.xy` that reaches `p.z` along x and `p.w` along y.
std::array<glm::dvec2, 4> cornersOf(const glm::dvec4& p) {
    const glm::dvec2 at(p.x, p.y), u(p.z, 0.3 * p.z), v(-0.2 * p.w, p.w);
    return {at, at + u, at + u + v, at + v};
}

/// Distance beyond the nearest edge, positive inside, for corners counterclockwise.
double depthInside(const std::array<glm::dvec2, 4>& corners, const glm::dvec2& p) {
    double least = 1e30;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 from = corners[i], along = corners[(i + 1) % 4] - from, to = p - from;
        least = std::min(least, (along.x * to.y - along.y * to.x) / glm::length(along));
    }
    return least;
}

TEST(Bitmask, TheBitsOfAQuadAreTheSamplesBehindIt) {
    const std::vector<glm::vec4> quads{{-0.9F, -0.9F, 1.9F, 1.7F},
                                       {-0.3F, -0.2F, 0.5F, 0.4F},
                                       {0.1F, 0.2F, 0.07F, 0.03F},
                                       {-4, -3, 9, 8},
                                       {-1.7F, 0.1F, 1.1F, 3},
                                       {0.8F, -2, 2, 2.3F},
                                       {2, 2, 1, 1},
                                       {-0.5F, -1, 0.02F, 2}};
    for (const int side : {8, 16}) {
        const std::vector<glm::vec2> samples = techniques::lightSamples(side);
        std::size_t set = 0;
        for (int row = 0; row < side; ++row) {
            const auto runs = evaluated(
                "shared/sampling/light_samples.glsl",
                fmt::format("float(runOfRow(edgesOf(x.xy, x.xy + x.z * vec2(1, 0.3), x.xy + x.z * vec2(1, 0.3) + x.w * "
                            "vec2(-0.2, 1), x.xy + x.w * vec2(-0.2, 1)), {}))",
                            row),
                quads, {{"SAMPLES", std::to_string(side)}});
            for (std::size_t quad = 0; quad < quads.size(); ++quad)
                for (int i = 0; i < side; ++i) {
                    const auto number =
                        static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(i);
                    const bool bit = (static_cast<unsigned>(runs[quad].x) >> i & 1U) != 0;
                    const double inside = depthInside(cornersOf(glm::dvec4(quads[quad])), glm::dvec2(samples[number]));
                    set += bit ? 1 : 0;
                    if (std::abs(inside) < 1e-4) continue;
                    EXPECT_EQ(bit, inside > 0) << quad << " " << row << " " << i;
                }
        }
        EXPECT_GT(set, static_cast<std::size_t>(side * side));
    }
}

TEST(Bitmask, VisibilityIsANumberOfSamples) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    std::set<int> levels64, levels256;
    for (const float v : rendered(stage, "bitmask:window=all")) {
        EXPECT_NEAR(64 * v, std::round(64 * v), 1e-4);
        levels64.insert(static_cast<int>(std::lround(256 * v)));
    }
    for (const float v : rendered(stage, all)) {
        EXPECT_NEAR(256 * v, std::round(256 * v), 1e-4);
        levels256.insert(static_cast<int>(std::lround(256 * v)));
    }
    EXPECT_GT(levels256.size(), levels64.size());
}

TEST(Bitmask, OccludersThatOverlapOnTheLightCountOnce) {
    const Scene scene = stripScene(touchingStrips);
    Stage stage(scene);
    stage.show(0);
    const auto points = stripPoints(stage, rendered(stage, all), touchingStrips);
    double most = 0;
    for (const SlabPoint& point : points) {
        const double delta = hiddenBy(touchingStrips, scene.light, point.at).overlap();
        if (delta < 0.05) continue;
        EXPECT_NEAR(point.visibility, point.truth, 0.07); // edges of half a texel and its own place
        most = std::max(most, delta);
    }
    EXPECT_GT(most, 0.2);
}

TEST(Bitmask, ACasterThatTheLightsCentreDoesNotSeeDoesNotOcclude) { // one layer
    const Scene scene = stripScene(hiddenStrip);
    Stage stage(scene);
    stage.show(0);
    const auto points = stripPoints(stage, rendered(stage, all), hiddenStrip);
    const double hidden = hiddenBy({hiddenStrip[0]}, scene.light, {0.1, 0, 0}).once;
    EXPECT_NEAR(visibilityAt(points, 0.1), 1 - hidden, 0.03);
    EXPECT_GT(hiddenBy(hiddenStrip, scene.light, {0.1, 0, 0}).once - hidden, 0.3);
}

TEST(Bitmask, SmallWindowsLoseABarUnderALargeLight) { // Fig. 4.3: contact and thin casters
    const std::vector<Strip> bar{{2, 0, 0.2}};
    Scene scene = stripScene(bar);
    scene.light.u.x = scene.light.v.z = 6;
    Stage stage(scene);
    stage.show(0);
    const auto errorOf = [&](const std::string& variant) {
        const auto points = stripPoints(stage, rendered(stage, variant), bar);
        return rmsErrorWhere(points, [](const SlabPoint& point) { return point.truth < 0.901; });
    };
    // The light's image at the bar is 2 m: a square of its eighth or quarter is larger than the bar.
    EXPECT_GT(errorOf(small), 0.05);
    EXPECT_LT(errorOf(all), 0.02);
}

double quadsOf(Stage& stage, const std::string& variant) { return figuresOf(stage, variant).at("quads"); }

TEST(Bitmask, AWindowHasNoMoreMicroquadsThanItSays) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    for (const char* map : {"512", "1024"}) {
        EXPECT_LT(quadsOf(stage, fmt::format("bitmask:map={}", map)), 64);
        EXPECT_LT(quadsOf(stage, fmt::format("bitmask:window=12,map={}", map)), 144);
    }
    EXPECT_GT(quadsOf(stage, "bitmask:window=12"), 1.5 * quadsOf(stage, "bitmask"));

    const Scene falling = fallingPlateScene();
    Stage slanted(falling);
    slanted.show(0);
    const std::string every = "bitmask:window=all,flat=0";
    EXPECT_GT(quadsOf(slanted, every), 3 * quadsOf(slanted, every + ",map=512"));
    EXPECT_NEAR(quadsOf(slanted, "bitmask") / quadsOf(slanted, "bitmask:map=512"), 1, 0.1);
}

TEST(Bitmask, AWideAreaIsLookedThroughToItsEnd) {
    const Scene scene = fallingPlateScene();
    Stage stage(scene);
    stage.show(0);
    const std::string every = all + ",flat=0,map=4096"; // some 240 texels across, none of them merged
    EXPECT_LT(halfPlaneError(stage, every), 0.02);
}

TEST(Bitmask, ADisksSamplesAreThoseOnTheDisk) {
    Scene scene = halfPlaneScene();
    scene.light.kind = LightKind::Disk;
    Stage stage(scene);
    stage.show(0);
    const auto points = slabPoints(stage, rendered(stage, all));
    const auto visible = [](double cut) { // of a disk beside a line at `cut` radii from its centre
        return 1 - (std::acos(cut) - cut * std::sqrt(1 - cut * cut)) / 3.14159265358979;
    };
    for (const double cut : {-0.6, 0.0, 0.6}) // 0.375 m of slab for the radius
        EXPECT_NEAR(visibilityAt(points, hardEdge - cut * 0.375), visible(cut), 0.04) << cut;
}

TEST(Bitmask, RefusesMoreSamplesThanBits) {
    try {
        techniques::parseVariant("bitmask:samples=256");
        FAIL() << "taken";
    } catch (const BadInput& error) {
        EXPECT_STREQ(error.what(), "bitmask: 256 samples do not fit into 64 bits, one each: choose bits=256");
    }
    EXPECT_THROW(techniques::parseVariant("bitmask:samples=100"), BadInput);
    EXPECT_THROW(techniques::parseVariant("bitmask:window=9"), BadInput);
    Scene scene = halfPlaneScene();
    scene.light.kind = LightKind::Line;
    EXPECT_EQ(techniques::entryNamed("bitmask").notApplicable(scene),
              "samples the surface of a light; the light of test is a line");
}

} // namespace
} // namespace shadowbench
