// Penumbra maps: eq. 2.2's own ramp along sheets and around cones, and the umbra that never shrinks.
#include "base/error.h"
#include "base/random.h"
#include "tests/support/plate_scene.h"
#include "tests/support/soft_scenes.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Eq. 2.2 on a ground 6 m below a light of this radius, `out` metres outside the hard shadow of a vertex or an edge 4 m
/// below it. Where the light's image is `out` / 6 away from the vertex, a cone whose radius is that of the outer penumbra
/// has 1 / Z_F = 1 / Z_v − out / (6 · radius).
double intensity(double out, double radius) {
    const double inverse = 1.0 / 4 - out / (6 * radius);
    return inverse <= 1.0 / 6 ? 1.0 : (1 / inverse - 4) / (6 - 4);
}

TEST(PenumbraMap, ThePenumbraIsEquationTwoPointTwosRampOutsideTheHardShadow) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto points = slabPoints(stage, rendered(stage, "penumbra-map:map=2048"));
    EXPECT_NEAR(intensity(hardEdge - litUntil, 0.75), 1, 1e-9);
    EXPECT_NEAR(intensity(0.5 * (hardEdge - litUntil), 0.75), 0.4, 1e-9); // not a half: linear in depth
    for (double x = 0.06; x < 0.38; x += 0.04)
        EXPECT_NEAR(visibilityAt(points, x), intensity(hardEdge - x, 0.75), 0.03) << x; // a texel is 0.03 to 0.07
    for (const SlabPoint& point : points) {
        const double x = point.at.x;
        EXPECT_TRUE(x > litUntil - 0.03 || point.visibility == 1) << x;
        EXPECT_TRUE(x < hardEdge + 0.03 || point.visibility == 0) << x;
    }
    // A linear ramp over the outer half would err by ½/√3; this one is darker. With u from 0 at the hard edge to 1 at the
    // rim it is 2u / (3 − u) for a truth of ½ + ½u, and 0 for ½ − ½u within the edge: 0.320.
    EXPECT_NEAR(penumbraRmsError(points), 0.320, 0.015);
}

TEST(PenumbraMap, ACornerIsACone) {
    const Scene scene = plateScene(1);
    Stage stage(scene);
    stage.show(0);
    double corner = 0;
    std::size_t pixels = 0;
    for (const PlatePoint& p : platePoints(scene, stage, rendered(stage, "penumbra-map"))) {
        const double expected = intensity(std::hypot(p.x, p.z), 0.5);
        if (p.x == 0 || p.z == 0 || expected == 1) continue;
        corner += std::abs(p.visibility - expected);
        ++pixels;
    }
    EXPECT_GT(pixels, 60U);
    EXPECT_LT(corner / static_cast<double>(pixels), 0.02); // a texel is 2 cm of 25
}

TEST(PenumbraMap, HasAConeForEachVertexAndASheetForEachEdge) {
    const Scene scene = plateScene(1);
    Stage stage(scene);
    stage.show(0);
    const auto figures = figuresOf(stage, "penumbra-map");
    EXPECT_EQ(figures.at("penumbra_cones"), 4 + 4); // the tops of plate and slab
    EXPECT_EQ(figures.at("penumbra_sheets"), 4 + 4);
}

/// A sheet of metal whose edge, z = 0.5, rises from 0.5 m to 4 m, under a round light of radius 0.5 m.
Scene risingEdge() {
    Scene scene = groundScene();
    scene.light = {LightKind::Disk, {0, 6, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    scene.camera = {{0.3, 3.4, 7}, {0.2, 0, 0.7}, {0, 1, 0}, 36, 0.5, 40};
    const Mesh sheet{
        {{-0.3F, 0.5F, 0.5F}, {0.3F, 4, 0.5F}, {0.3F, 4, -1.5F}, {-0.3F, 0.5F, -1.5F}}, {{0, 1, 2}, {0, 2, 3}}, false};
    scene.objects.push_back(object(sheet, {0, 0, 0}));
    return scene;
}

TEST(PenumbraMap, ASheetIsTangentToTheConesOfItsEnds) {
    const Scene scene = risingEdge();
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "penumbra-map:map=2048");
    const metrics::Drawn drawn = stage.drawn();
    // The cones meet the ground in circles around the shadows of the edge's ends.
    const glm::dvec2 a = glm::dvec2(-0.3, 0.5) * 6.0 / 5.5, b = glm::dvec2(0.3, 0.5) * 6.0 / 2.0;
    const double ra = 0.5 * 0.5 / 5.5, rb = 0.5 * 4 / 2;
    const glm::dvec2 along = glm::normalize(b - a), across(-along.y, along.x);
    const double sine = (ra - rb) / glm::length(b - a);
    const glm::dvec2 tangent = sine * along + std::sqrt(1 - sine * sine) * across; // from each centre to its circle
    const glm::dvec2 direction(tangent.y, -tangent.x);
    std::size_t inside = 0, outside = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec2 p(drawn.position[i].x, drawn.position[i].z);
        const double share = glm::dot(p - a, direction) / glm::dot(b - a, direction);
        const double beyond = glm::dot(p - a, tangent) - ra;
        if (drawn.id[i] != 1 || share < 0.1 || share > 0.9 || std::abs(beyond) > 0.3 || std::abs(beyond) < 0.02) continue;
        EXPECT_EQ(v[i] == 1, beyond > 0) << p.x << ", " << p.y << ": " << beyond;
        ++(beyond > 0 ? outside : inside);
    }
    EXPECT_GT(inside, 100U);
    EXPECT_GT(outside, 100U);
}

TEST(PenumbraMap, TheUmbraKeepsItsSizeAsTheLightGrows) { // dissertation 2.3.2: no inner penumbra
    EXPECT_NEAR(trueLossOfUmbra(), 0.84, 0.02);
    EXPECT_LE(lossOfUmbra("penumbra-map"), 0.02);
}

TEST(PenumbraMap, WherePenumbraeOverlapTheDarkerOneIsKept) { // minimum blending
    expectTheDarkerWhereTwoOverlap("penumbra-map");
}

TEST(PenumbraMap, TopsOfCastersAreLitUpToTheirRims) { expectTopsLitUpToTheirRims("penumbra-map"); }

/// The plate over grass whose blades are triangles.
Scene grassScene() {
    Scene scene = plateScene(1, 256);
    Random random(7);
    Mesh grass;
    for (int i = 0; i < 600; ++i) {
        const glm::vec3 foot(random.uniform(-2, 2), 0, random.uniform(-2, 2));
        const auto first = static_cast<std::uint32_t>(grass.positions.size());
        const glm::vec3 side(random.uniform(-0.05, 0.05), 0, random.uniform(-0.05, 0.05));
        grass.positions.insert(grass.positions.end(), {foot, foot + side, foot + glm::vec3(0, 0.3, 0)});
        grass.triangles.emplace_back(first, first + 1, first + 2);
    }
    scene.objects.push_back(object(grass, {0, 0, 0}));
    return scene;
}

/// Where a caster touches the ground, rounding may put a cone before its vertex, or the ground between the two.
TEST(PenumbraMap, IsAShareAtContacts) {
    Scene scene = grassScene();
    const Light above = scene.light;
    for (const Light& light :
         {above, Light{LightKind::Rectangle, {4, 7, 6}, {-0.4, -0.7, -0.6}, {1, 0, 0}, {0, 0.6, -0.7}}}) {
        scene.light = light;
        Stage stage(scene);
        stage.show(0);
        for (const float v : rendered(stage, "penumbra-map")) ASSERT_TRUE(v >= 0 && v <= 1) << v;
    }
}

TEST(PenumbraMap, RefusesWhatItCannotAnswer) {
    EXPECT_THROW(techniques::parseVariant("penumbra-map:map=8"), BadInput);
    Scene scene = halfPlaneScene();
    const techniques::Entry& entry = *techniques::parseVariant("penumbra-map").entry;
    EXPECT_FALSE(entry.notApplicable(scene));
    scene.light.kind = LightKind::Line;
    EXPECT_TRUE(entry.notApplicable(scene));
}

} // namespace
} // namespace shadowbench
