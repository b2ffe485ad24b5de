// Penumbra wedges: exact under one planar polygon, whichever side of it and wherever the eye is; wrong where the silhouette
// changes over the light or casters overlap, and less so over parts of the light.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "scene/load/load.h"
#include "tests/support/area_truth.h"
#include "tests/support/shader_function.h"
#include "tests/support/soft_scenes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// What the rounding of 32-bit floats leaves of an exact technique, with room: points lie micrometres off, and the light is
/// a metre wide.
constexpr double rmsOfPolygon = 1e-4, mostOfPolygon = 1e-3;

void expectExact(const Scene& scene, const std::string& variant = "penumbra-wedge") {
    Stage stage(scene);
    stage.show(0);
    const AreaError error = errorOfArea(stage, rendered(stage, variant));
    EXPECT_LE(error.rms, rmsOfPolygon) << variant;
    EXPECT_LE(error.most, mostOfPolygon) << variant;
}

/// An L with its top up.
Mesh letter() {
    return {{{0, 0, 0}, {1.2F, 0, 0}, {1.2F, 0, 0.5F}, {0.5F, 0, 0.5F}, {0.5F, 0, 1.3F}, {0, 0, 1.3F}},
            {{0, 3, 1}, {1, 3, 2}, {0, 4, 3}, {0, 5, 4}},
            false};
}

/// The slab under the L, turned and tilted, and a light that is neither square nor parallel to anything.
Scene letterScene(const Mesh& mesh = letter(), int side = 96) {
    Scene scene = groundScene(side);
    scene.light = {LightKind::Rectangle, {0.4, 6, 0.2}, {0, -1, 0}, {1.2, 0.1, 0.5}, {-0.4, -0.0461538, 0.9692308}};
    scene.camera = {{1.1, 5.2, 5.3}, {0.1, 0.3, 0.2}, {0, 1, 0}, 40, 0.5, 40};
    scene.objects.push_back(object(mesh, {-0.4, 1.6, -0.3}, 31));
    glm::dmat4& place = scene.objects[1].instances[0].place;
    place = glm::rotate(place, glm::radians(23.0), glm::dvec3(1, 0, 0.4));
    return scene;
}

Mesh turnedOver(Mesh mesh) {
    for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
    return mesh;
}

TEST(PenumbraWedge, IsExactUnderOnePlanarPolygonOnWhicheverSideTheLightIs) {
    expectExact(letterScene());
    expectExact(letterScene(turnedOver(letter())));
}

TEST(PenumbraWedge, IsExactOverPartsOfTheLightToo) {
    expectExact(letterScene(), "penumbra-wedge:side=2");
    expectExact(letterScene(), "penumbra-wedge:side=3");
}

TEST(PenumbraWedge, IsExactUnderADisk) {
    Scene scene = letterScene();
    scene.light = {LightKind::Disk, {0.4, 6, 0.2}, {0, -1, 0}, {1.3, 0, 0.2}, {-0.2, 0, 1.3}};
    expectExact(scene);
    expectExact(scene, "penumbra-wedge:side=3"); // the same: a disk has no parts
}

TEST(PenumbraWedge, IsExactWithTheEyeInTheShadow) {
    Scene scene = letterScene();
    scene.camera = {{-0.1, 0.7, 0.2}, {0.1, 0, 0.3}, {0, 1, 0}, 90, 0.01, 40}; // umbra, penumbra and light before it
    expectExact(scene);
    scene.camera.eye = {-0.3, 0.9, 1.1}; // in the penumbra, on the lit side of its middle
    expectExact(scene);
}

TEST(PenumbraWedge, IsExactOnBothSidesOfTheLight) {
    Scene scene = letterScene();
    scene.light.centre = {0.1, 2.6, 0.1};
    scene.objects.push_back(object(letter(), {-0.5, 3.4, -0.4}));
    scene.objects.push_back(object(box({12, 0.2, 12}), {0, 5.1, 0}));
    scene.camera = {{-0.6, 2.3, 5.9}, {0.1, 3.9, 0.1}, {0, 1, 0}, 60, 0.1, 40}; // looks at the ceiling
    expectExact(scene);
    scene.camera.target = {0.1, 0.2, 0.1};
    expectExact(scene);
}

TEST(PenumbraWedge, ThePenumbraUnderAHalfPlaneIsLinear) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_LE(penumbraRmsError(slabPoints(stage, rendered(stage, "penumbra-wedge"))), 1e-3); // the plate is 2 mm thick
}

/// Turned about the light's middle, for coordinates that rounding does not spare.
Scene turnedAbout(Scene scene, const glm::dmat4& turn) {
    const auto direction = [&](const glm::dvec3& v) { return glm::dvec3(turn * glm::dvec4(v, 0)); };
    const auto place = [&](const glm::dvec3& v) { return glm::dvec3(turn * glm::dvec4(v, 1)); };
    scene.light.u = direction(scene.light.u);
    scene.light.v = direction(scene.light.v);
    scene.camera.eye = place(scene.camera.eye);
    scene.camera.target = place(scene.camera.target);
    scene.camera.up = direction(scene.camera.up);
    for (Object& turned : scene.objects)
        for (Instance& instance : turned.instances) instance.place = turn * instance.place;
    return scene;
}

TEST(PenumbraWedge, HasNoSeamWhereTheHardShadowEnds) {
    Scene scene = halfPlaneScene(97);
    // Looks straight down from below the plate: all of the middle column lies on the border of the hard shadow, so that
    // rounding says of each pixel on which side it is.
    scene.camera = {{hardEdge, 1.8, 0.2}, {hardEdge, 0, 0.2}, {0, 0, -1}, 30, 0.1, 40};
    glm::dmat4 turn = glm::translate(glm::dmat4(1), scene.light.centre);
    turn = glm::rotate(turn, glm::radians(31.0), glm::dvec3(0, 1, 0));
    turn = glm::translate(turn, -scene.light.centre);
    const Scene turned = turnedAbout(scene, turn);
    Stage stage(turned);
    stage.show(0);
    const Image<float> v = rendered(stage, "penumbra-wedge");
    const metrics::Drawn drawn = stage.drawn();
    for (int y = 0; y < v.height(); ++y)
        for (int x = 0; x < v.width(); ++x) {
            const glm::dvec3 point(glm::inverse(turn) * glm::dvec4(glm::dvec3(drawn.position(x, y)), 1));
            EXPECT_NEAR(v(x, y), halfPlaneVisibility(point), 2e-3) << x << ", " << y;
        }
}

TEST(PenumbraWedge, ATriangleWithoutAreaChangesNothing) {
    // It lies between the border from 0 to 5 and a vertex on it, where the border's triangle is cut in two.
    Mesh split = letter();
    split.positions.emplace_back(0.0F, 0.0F, 0.65F);
    split.triangles[3] = {0, 6, 4};
    split.triangles.push_back({6, 5, 4});
    split.triangles.push_back({6, 0, 5}); // closes the gap of no width
    const Scene with = letterScene(split), without = letterScene();
    Stage one(with), other(without);
    one.show(0);
    other.show(0);
    const Image<float> v = rendered(one, "penumbra-wedge"), expected = rendered(other, "penumbra-wedge");
    for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], expected[i], 1e-4);
}

// ---- structure ----

TEST(PenumbraWedge, HasAQuadAndAWedgeForEachSilhouetteEdgeOfEachPart) {
    Scene scene = boxScene(64);
    scene.light = {LightKind::Rectangle, {0.13, 6, 0.21}, {0, -1, 0}, {0.2, 0, 0}, {0, 0, 0.2}};
    Stage stage(scene);
    stage.show(0);
    for (const int side : {1, 2, 3}) { // every part stands above the tops of slab and box alone
        const auto figures = figuresOf(stage, fmt::format("penumbra-wedge:side={}", side));
        EXPECT_EQ(figures.at("shadow_quads"), side * side * (4 + 4));
        EXPECT_EQ(figures.at("penumbra_wedges"), side * side * (4 + 4));
    }
}

/// The ends of a line across the light at distance x from its middle, turned by some angle.
std::vector<glm::vec4> linesAcross(double reach) {
    std::vector<glm::vec4> lines;
    for (const double x : {0.001, 0.3, 0.62, 0.97})
        for (const double turn : {0.0, 0.5, 1.0, 1.5}) {
            const double angle = turn * glm::pi<double>();
            const glm::dvec2 out(std::cos(angle), std::sin(angle)), along(-out.y, out.x);
            lines.emplace_back(glm::vec2(x * out - reach * along), glm::vec2(x * out + reach * along));
        }
    return lines;
}

TEST(PenumbraWedge, CoverageIsTheLightsAreaBehindTheEdge) {
    const std::string chunk = "volumes/penumbra-wedge/coverage.glsl";
    const auto distance = [](const glm::vec4& line) { return 0.5 * std::hypot(line.x + line.z, line.y + line.w); };
    const std::vector<glm::vec4> lines = linesAcross(1);
    const auto ofSquare = evaluated(chunk, "coverageOfSquare(x.xy, x.zw)", lines);
    const auto reversed = evaluated(chunk, "coverageOfSquare(x.zw, x.xy)", lines);
    const auto ofDisk = evaluated(chunk, "coverageOfDisk(x.xy, x.zw)", lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double x = distance(lines[i]);
        EXPECT_NEAR(ofSquare[i].x, 0.5 * (1 - x), 1e-6) << x;
        EXPECT_EQ(ofSquare[i].x, reversed[i].x);
        EXPECT_NEAR(ofDisk[i].x, (std::acos(x) - x * std::sqrt(1 - x * x)) / glm::pi<double>(), 1e-5) << x;
    }
    // Two edges that meet cover what one in their place does; an edge towards the middle covers nothing.
    const auto parts =
        evaluated(chunk,
                  "vec4(coverageOfSquare(x.xy, mix(x.xy, x.zw, 0.3)) + coverageOfSquare(mix(x.xy, x.zw, 0.3), "
                  "x.zw), coverageOfSquare(0.9 * x.xy, 0.2 * x.xy), 0, 0)",
                  lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_NEAR(parts[i].x, ofSquare[i].x, 1e-6);
        EXPECT_NEAR(parts[i].y, 0, 1e-6);
    }
}

// ---- where it breaks ----

TEST(PenumbraWedge, ErrsUnderACubeWhoseSilhouetteChangesAndLessOverPartsOfTheLight) { // course, Disadvantages; K29
    testContext();
    Scene scene = loadScene("cube-silhouette", Profile::Gate);
    scene.size = {96, 96};
    Stage stage(scene);
    stage.show(0);
    const auto rms = [&](const char* variant) { return errorOfArea(stage, rendered(stage, variant)).rms; };
    const double one = rms("penumbra-wedge"), two = rms("penumbra-wedge:side=2"), three = rms("penumbra-wedge:side=3");
    EXPECT_GT(one, 0.02);
    EXPECT_LT(two, one);
    EXPECT_LE(three, 0.5 * one);
}

TEST(PenumbraWedge, HidesTwiceWhatTwoCastersHide) { // course, Disadvantages: overlapping geometry
    const Scene scene = stripScene(touchingStrips);
    Stage stage(scene);
    stage.show(0);
    const auto points = stripPoints(stage, rendered(stage, "penumbra-wedge"), touchingStrips);
    double worst = 0, overlap = 0;
    for (const SlabPoint& point : points) {
        const HiddenShare hidden = hiddenBy(touchingStrips, scene.light, point.at);
        worst = std::max(worst, std::abs(point.visibility - std::max(0.0, 1 - hidden.each)));
        overlap = std::max(overlap, point.truth - point.visibility);
    }
    EXPECT_LT(worst, 0.01); // the strips are 2 mm thick
    EXPECT_GT(overlap, 0.05);
    // Of nine parts of the light, the strips overlap before fewer.
    const auto parts = stripPoints(stage, rendered(stage, "penumbra-wedge:side=3"), touchingStrips);
    EXPECT_LT(rmsError(parts), 0.7 * rmsError(points));
}

// ---- cost ----

timing::FramePasses passesOf(Stage& stage, const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    stage.render(*technique, 0, 1);
    return timing::measurePasses(stage, *technique, 0, 1, 1);
}

std::uint64_t fragmentsOf(const timing::FramePasses& passes, const std::string& name) {
    for (const timing::PassCost& pass : passes.passes)
        if (pass.name == name) return pass.work.fragments;
    return 0;
}

TEST(PenumbraWedge, FourPartsCostLessThanFourTimesTheWhole) { // course, Disadvantages; K29
    testContext();
    const Scene scene = loadScene("overlapping-occluders", Profile::Gate);
    Stage stage(scene);
    stage.show(0);
    const timing::FramePasses one = passesOf(stage, "penumbra-wedge"), four = passesOf(stage, "penumbra-wedge:side=2");
    EXPECT_LT(four.frame().work.fragments, 4 * one.frame().work.fragments);
    // Without the G-buffer, too: the wedges of a part are half as wide.
    EXPECT_GT(fragmentsOf(one, "penumbra wedges"), 0U);
    EXPECT_LT(static_cast<double>(fragmentsOf(four, "penumbra wedges")),
              3.5 * static_cast<double>(fragmentsOf(one, "penumbra wedges")));
}

TEST(PenumbraWedge, RefusesWhatItCannotAnswer) {
    for (const char* wrong : {"penumbra-wedge:side=0", "penumbra-wedge:side=9", "penumbra-wedge:side=1.5"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
    Scene scene = halfPlaneScene();
    const techniques::Entry& entry = *techniques::parseVariant("penumbra-wedge").entry;
    EXPECT_FALSE(entry.notApplicable(scene));
    scene.light.kind = LightKind::Line;
    EXPECT_EQ(entry.notApplicable(scene), "needs a light with a width and a height; the light of test is a line");
}

} // namespace
} // namespace shadowbench
