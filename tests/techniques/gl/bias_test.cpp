// Depth bias and normal offset against closed forms: how deep a surface may lie where its map was sampled beside it, and how
// much of a contact shadow that costs (docs/techniques.md, "Bias").
#include "techniques/shared/light_views/light_view.h"
#include "tests/support/stages.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <string>

namespace shadowbench {
namespace {

/// A prism along z whose two facets fall off by `left` and `right` metres per metre from a ridge above the origin.
Mesh roof(float left, float right, float height = 1, float half = 3) {
    const float low = -height / left, high = height / right;
    Mesh mesh;
    mesh.positions = {{low, 0, -half}, {high, 0, -half}, {0, height, -half},
                      {low, 0, half},  {high, 0, half},  {0, height, half}};
    mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}, {0, 1, 4}, {0, 4, 3}};
    mesh.closed = true;
    return mesh;
}

constexpr double turn = 41; // of a roof, degrees: near the diagonal, with the ridge at ever other places of a texel
constexpr glm::dvec2 top{0.03, 0.07}; // a point of its ridge

/// The slab under a light from straight above, so that heights are depths, with a roof seen from above. The roof's slopes
/// lie nearly across the map's texels, where |∂z/∂x| + |∂z/∂y| is nearly twice the greater of the two.
Scene roofScene(float left, float right) {
    Scene scene = groundScene(384);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0.1, 9, 0.2}, {0, 0, 0}, {0, 0, -1}, 40, 0.5, 40};
    scene.objects.push_back(object(roof(left, right), {top.x, 0, top.y}, turn));
    return scene;
}

constexpr int map = 128;
constexpr double texel = 12.0 / map; // metres: the map spans the slab

struct Dark {
    std::size_t pixels = 0;
    double farthest = 0; // from the ridge, metres
};

/// Pixels of the object `id`, at a height of at least `lowest`, that are shadowed. Nothing is above it: all of them are
/// acne.
Dark acneOn(unsigned id, const Scene& scene, const std::string& variant, float lowest = -1) {
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, variant + ",map=" + std::to_string(map));
    const metrics::Drawn drawn = stage.drawn();
    const Image<glm::vec3> normals = stage.normals();
    const glm::dvec2 across(std::cos(glm::radians(turn)), -std::sin(glm::radians(turn))); // the ridge
    Dark dark;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (drawn.id[i] != id || drawn.position[i].y < lowest || normals[i].y < 0.05F || v[i] >= 0.5F) continue;
        ++dark.pixels;
        const glm::dvec3 p = drawn.position[i];
        dark.farthest = std::max(dark.farthest, std::abs(glm::dot(across, glm::dvec2(p.x, p.z) - top)));
    }
    return dark;
}

// Where a texel's centre lies on a facet of slope b and the receiver half a texel away on one of slope a, with the ridge a
// share t of the way between, the receiver is deeper by (1 − t) a − t b slopes.
TEST(Bias, AFactorCoversFacetsAsManyTimesAsSteepAsTheirNeighbours) {
    const Scene scene = roofScene(0.5F, 0.95F);
    EXPECT_EQ(acneOn(2, scene, "sm-uniform:factor=2").pixels, 0U);
    EXPECT_GT(acneOn(2, scene, "sm-uniform:factor=1").pixels, 5U);
}

TEST(Bias, ItsDefaultIsAFactorOfTwo) {
    EXPECT_EQ(techniques::parseVariant("sm-uniform:factor=2").name, "sm-uniform");
    EXPECT_EQ(techniques::parseVariant("sm-silhouette:factor=2").name, "sm-silhouette");
}

TEST(Bias, BeyondTheFactorATexelAtTheRidgeIsWrongAndNoMore) {
    const Scene scene = roofScene(0.25F, 1.0F);
    const Dark dark = acneOn(2, scene, "sm-uniform:factor=2");
    EXPECT_GT(dark.pixels, 5U);
    EXPECT_LT(dark.farthest, std::sqrt(0.5) * texel); // half a diagonal
    EXPECT_EQ(acneOn(2, scene, "sm-uniform:factor=4").pixels, 0U);
}

// A convex body lies behind the plane of each of its facets, and an offset that suffices on the plane suffices on it.
TEST(NormalOffset, AConvexBodyDoesNotShadeItselfHoweverSteepItsFacets) {
    for (const auto& [left, right] : {std::pair{0.5F, 0.95F}, {0.25F, 1.0F}, {0.2F, 4.0F}})
        EXPECT_EQ(acneOn(2, roofScene(left, right), "sm-uniform:bias=normal-offset,factor=1").pixels, 0U)
            << left << " " << right;
    EXPECT_GT(acneOn(2, roofScene(0.5F, 0.95F), "sm-uniform:bias=normal-offset,factor=0.8").pixels, 5U);
}

// A ground that faces the light has no offset, but the texel beside it may hold a wall that rises from it.
TEST(NormalOffset, LeavesAcneAtTheFootOfASlope) {
    const Scene scene = roofScene(1, 1);
    EXPECT_GT(acneOn(1, scene, "sm-uniform:bias=normal-offset").pixels, 5U);
    EXPECT_EQ(acneOn(1, scene, "sm-uniform:bias=slope").pixels, 0U);
}

/// A thin plate `gap` metres above the slab, seen from between the two, in slanted sun.
Scene gapScene(double gap) {
    Scene scene = groundScene(256);
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.8, -1, 0.6)), {}, {}};
    scene.camera = {{0, 0.5 * gap, 3}, {0, 0, 0}, {0, 1, 0}, 40, 0.01, 40};
    scene.objects.push_back(object(box({8, 0.0002, 8}), {0, gap + 0.0001, 0}));
    return scene;
}

/// Share of the slab in the middle of the plate's shadow that is shadowed; `slopes`: the plate's height above it, along the
/// light's axis, in slopes of the slab per texel.
double shadowedShare(double slopes, const std::string& variant) {
    const Scene probe = gapScene(0.1);
    const techniques::LightView view = techniques::fitToScene(probe.light, snapshot(probe, 0));
    // The map's rows are level, so that depth changes along its columns alone.
    const double cosine = -probe.light.direction.y, slope = std::sqrt(1 / (cosine * cosine) - 1) * view.span.y / map;
    const Scene scene = gapScene(slopes * slope * cosine);
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, variant + ",map=" + std::to_string(map));
    const metrics::Drawn drawn = stage.drawn();
    double shadowed = 0, all = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] != 1 || p.y < -0.001 || std::abs(p.x) > 2.5 || std::abs(p.z) > 2.5) continue;
        ++all;
        shadowed += v[i] < 0.5F ? 1 : 0;
    }
    EXPECT_GT(all, 300);
    return shadowed / all;
}

// A shadow is lost where its caster is nearer than the bias, give or take the half texel that the receiver lies beside its
// sample: half a slope.
TEST(Bias, AContactShadowBeginsAFactorOfSlopesBelowItsCaster) {
    for (const int factor : {1, 2, 4}) {
        const std::string variant = "sm-uniform:factor=" + std::to_string(factor);
        EXPECT_EQ(shadowedShare(factor + 0.55, variant), 1) << factor;
        EXPECT_NEAR(shadowedShare(factor, variant), 0.5, 0.1) << factor;
        EXPECT_EQ(shadowedShare(factor - 0.55, variant), 0) << factor;
    }
}

TEST(NormalOffset, AContactShadowBeginsHalfAFactorOfSlopesBelowItsCaster) {
    for (const int factor : {1, 2, 4}) {
        const std::string variant = "sm-uniform:bias=normal-offset,factor=" + std::to_string(factor);
        EXPECT_EQ(shadowedShare(0.5 * factor + 0.55, variant), 1) << factor;
        EXPECT_NEAR(shadowedShare(0.5 * factor, variant), 0.5, 0.1) << factor;
        if (factor > 1) {
            EXPECT_EQ(shadowedShare(0.5 * factor - 0.55, variant), 0) << factor;
        }
    }
}

TEST(NormalOffset, AllMapsWithOneViewAndAllOfPcfHaveIt) {
    const Scene scene = roofScene(0.2F, 4.0F);
    for (const char* id : {"sm-uniform", "sm-focused", "sm-silhouette", "pcf", "pcf-poisson", "pcf-jitter"})
        EXPECT_EQ(acneOn(2, scene, std::string(id) + ":bias=normal-offset", 0.4F).pixels, 0U)
            << id; // filters reach the foot
}

} // namespace
} // namespace shadowbench
