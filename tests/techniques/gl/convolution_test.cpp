// Convolution against its closed forms: exact for parallel planes, wrong for what spreads in depth.
#include "base/error.h"
#include "tests/support/plate_scenes.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

const std::string convolution = "convolution";

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = convolution) {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

double clustersOf(const Scene& scene, const std::string& variant = convolution) {
    Stage stage(scene);
    stage.show(0);
    return figuresOf(stage, variant).at("clusters");
}

TEST(Convolution, IsExactForParallelPlanes) {
    EXPECT_LT(penumbraRmsError(pointsOf(halfPlaneScene())), 0.01); // the texels of the blocker's image
}

TEST(Convolution, ASquareHidesItsShareOfTheLight) {
    Scene scene = halfPlaneScene();
    scene.objects[1] = object(box({0.25, 0.002, 0.25}), {0.1, 2.001, 0.2});
    // From below its middle it covers half the light's sides, a quarter of its area.
    EXPECT_NEAR(visibilityAround(pointsOf(scene), 0.1, 0.2), 0.75, 0.01);
}

TEST(Convolution, ADiskCountsAsARectangleOfItsArea) {
    Scene scene = halfPlaneScene();
    scene.light.kind = LightKind::Disk;
    const double share = 0.5 * std::sqrt(glm::pi<double>()); // of the disk's diameter
    double squares = 0, count = 0;
    for (const SlabPoint& point : pointsOf(scene)) {
        const double ramp = std::clamp(0.5 - (point.at.x - hardEdge) / (share * (umbraFrom - litUntil)), 0.0, 1.0);
        squares += (point.visibility - ramp) * (point.visibility - ramp);
        ++count;
    }
    EXPECT_LT(std::sqrt(squares / count), 0.01); // the texels of the blocker's image
}

TEST(Convolution, ALineIsConvolvedAlongItself) {
    Scene scene = halfPlaneScene();
    scene.light = {LightKind::Line, {0.1, 6, 0.2}, {0, -1, 0}, {1.5, 0, 0}, {}};
    // Across the edge it is the rectangle. Its map looks at the middle of the scene, past which the plate is a little
    // slanted.
    EXPECT_LT(penumbraRmsError(pointsOf(scene)), 0.05);
}

/// A mesh of `strips` plates side by side, which together are as large as `size`.
Mesh inStrips(const glm::dvec3& size, int strips) {
    const double width = size.x / strips;
    Mesh mesh;
    for (int i = 0; i < strips; ++i)
        mesh = joined(mesh, box({width, size.y, size.z}), glm::vec3((i + 0.5) * width - 0.5 * size.x, 0, 0));
    return mesh;
}

/// A plate of 4 × 4 m whose lower end, the line x = 0.3 at height 1.5 m, is parallel to the light's sides and which rises
/// from there at 45°.
Scene slantedScene(int strips = 1) {
    Scene scene = halfPlaneScene();
    Object plate = object(inStrips({4, 0.002, 4}, strips), {0, 0, 0});
    const double middle = 2 * std::sqrt(0.5);
    const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0.3 + middle, 1.5 + middle, 0.2));
    plate.instances[0].place = glm::rotate(place, glm::quarter_pi<double>(), glm::dvec3(0, 0, 1));
    scene.objects[1] = plate;
    return scene;
}

/// Whether that plate stands between two points, its thickness of 2 mm left out.
bool meetsSlanted(const glm::dvec3& a, const glm::dvec3& b) {
    const auto above = [](const glm::dvec3& p) { return (p.y - 1.5) - (p.x - 0.3); }; // the plate's plane
    if (above(a) * above(b) >= 0) return false;
    const glm::dvec3 p = a + above(a) / (above(a) - above(b)) * (b - a);
    return p.x > 0.3 && p.x < 0.3 + 4 * std::sqrt(0.5) && std::abs(p.z - 0.2) < 2;
}

double truthUnderSlanted(const glm::dvec3& p, const Light& light) {
    constexpr int side = 40;
    int visible = 0;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            if (!meetsSlanted(p, light.sample({(column + 0.5) / side, (row + 0.5) / side}))) ++visible;
    return static_cast<double>(visible) / (side * side);
}

/// Root mean square over the penumbra of a slanted plate, and over its umbra.
struct SlantedError {
    double penumbra, umbra;
};

SlantedError slantedError(int strips, const std::string& variant) {
    const Scene scene = slantedScene(strips);
    double inPenumbra = 0, penumbra = 0, inUmbra = 0, umbra = 0;
    for (const SlabPoint& point : pointsOf(scene, variant)) {
        const double truth = truthUnderSlanted(point.at, scene.light);
        const double square = (point.visibility - truth) * (point.visibility - truth);
        (truth > 0 ? inPenumbra : inUmbra) += truth < 1 ? square : 0;
        (truth > 0 ? penumbra : umbra) += truth < 1 ? 1 : 0;
    }
    EXPECT_GT(penumbra, 300);
    EXPECT_GT(umbra, 300);
    return {std::sqrt(inPenumbra / penumbra), std::sqrt(inUmbra / umbra)};
}

TEST(Convolution, ASlantedPlateHasThePenumbraOfItsMiddleAllAlong) { // what the dissertation admits
    for (const std::string clusters : {"1", "32"})                  // of two triangles, neither of which can be broken down
        EXPECT_GT(slantedError(1, "convolution:tolerance=0,clusters=" + clusters).penumbra, 0.05);
}

TEST(Convolution, ASlantedPlateOfManyPolygonsIsAsGoodAsItsClustersAreMany) {
    const auto error = [](int clusters) {
        return slantedError(32, fmt::format("convolution:tolerance=0,clusters={}", clusters));
    };
    const SlantedError one = error(1), four = error(4), sixteen = error(16);
    // The lower end's penumbra is 4.4, 1.8 and 1.2 times as wide as it should be: (1/m − 1/6) / (1/4.5 − 1/6) of a cluster's
    // middle depth m.
    EXPECT_GT(one.penumbra, 0.2);
    EXPECT_LT(four.penumbra, 0.6 * one.penumbra);
    EXPECT_LT(sixteen.penumbra, 0.5 * four.penumbra);
    EXPECT_LT(sixteen.umbra, 0.03); // hardly any light between what hides different parts of it
}

TEST(Convolution, TheUnionOfClustersIsNotTheirs) {
    // Two plates one above the other with one hard edge, where each hides the same half of the light.
    Scene apart = halfPlaneScene();
    apart.objects.push_back(plate(1, edgeFor(1, hardEdge)));
    Scene together = apart;
    together.objects.pop_back();
    const Mesh mesh = *apart.objects[1].levels[0].mesh;
    together.objects[1] =
        object(joined(joined({}, mesh, {edgeFor(2, hardEdge) + 10, 2.001, 0}), mesh, {edgeFor(1, hardEdge) + 10, 1.001, 0}),
               {0, 0, 0});
    EXPECT_NEAR(visibilityAt(pointsOf(apart), hardEdge), 0.25, 0.02); // as though independent
    EXPECT_LT(visibilityAt(pointsOf(together), hardEdge), 0.1);       // as though beside each other: 0, but for texels
    EXPECT_NEAR(visibilityAt(pointsOf(halfPlaneScene()), hardEdge), 0.5, 0.02); // the truth
}

TEST(Convolution, BlockersOfOneDepthAreOneImage) {
    EXPECT_EQ(clustersOf(halfPlaneScene()), 1);
    Scene scene = halfPlaneScene();
    for (const double height : {1.0, 3.0, 4.0}) scene.objects.push_back(plate(height, 2));
    scene.objects.push_back(object(box({0.5, 0.1, 0.5}), {-3, 3, 0})); // beside the third
    EXPECT_EQ(clustersOf(scene), 4);
    EXPECT_EQ(clustersOf(scene, "convolution:map=256,clusters=3"), 3);
    EXPECT_EQ(clustersOf(scene, "convolution:map=256,tolerance=1"), 1);
}

TEST(Convolution, NoShadowFallsWithinACluster) { // what the subdivision is for
    Scene scene = halfPlaneScene();
    scene.objects.push_back(plate(0.3, -6)); // under all of the slab's pixels' light
    scene.objects[0] = object(box({12, 0.2, 12}), {0, -0.1, 0});
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const auto darkest = [&](const std::string& variant) { // of the lower plate
        const Image<float> v = rendered(stage, variant);
        float least = 1;
        for (std::size_t i = 0; i < v.size(); ++i)
            if (drawn.id[i] == 3 && drawn.position[i].y > 0.3) least = std::min(least, v[i]);
        return least;
    };
    EXPECT_LT(darkest("convolution:map=256"), 0.01);
    EXPECT_EQ(darkest("convolution:map=256,clusters=1"), 1);
}

TEST(Convolution, RefusesBadInput) {
    EXPECT_THROW(techniques::parseVariant("convolution:clusters=33"), BadInput); // more than a texel has bits
    EXPECT_THROW(techniques::parseVariant("convolution:map=4096"), BadInput);    // more than the sums have room for
}

} // namespace
} // namespace shadowbench
