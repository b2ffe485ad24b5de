// Layered attenuation maps: as good as the maps that they are made from, and free as long as nothing moves.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "tests/support/sample_truth.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench {
namespace {

std::unique_ptr<techniques::Technique> made(const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    return variant.entry->make(variant.parameters);
}

/// Root mean square of the difference of two images over the receivers of the light.
double differenceOnReceivers(const Stage& stage, const Image<float>& a, const Image<float>& b) {
    const auto primary = groundtruth::hard::primaryHits(stage.shown(), {a.width(), a.height()});
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (primary.surface[i] != groundtruth::Surface::Receiver) continue;
        sum += (a[i] - b[i]) * (a[i] - b[i]);
        ++count;
    }
    EXPECT_GT(count, 1000);
    return std::sqrt(sum / count);
}

TEST(LayeredAttenuation, IsNearTheMapsThatItIsMadeFrom) {
    for (const Scene& scene : {halfPlaneScene(), overlapScene()}) {
        Stage stage(scene);
        stage.show(0);
        // A sample more or less: the texels of the maps lie elsewhere.
        EXPECT_LE(differenceOnReceivers(stage, rendered(stage, "layered-attenuation"), rendered(stage, "sampled-maps")),
                  1.0 / 64);
    }
}

/// Of the front side of the box of steepSideScene().
double meanOnWall(Stage& stage, const std::string& variant) {
    const Image<float> v = rendered(stage, variant);
    const metrics::Drawn drawn = stage.drawn();
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] != 2 || p.z < -0.301 || p.y < 0.1 || p.y > 1.9 || std::abs(p.x - 0.1) > 0.7) continue;
        sum += v[i];
        ++count;
    }
    EXPECT_GT(count, 100);
    return sum / count;
}

TEST(LayeredAttenuation, ASteepReceiverTakesAllLayersOfItsTexels) {
    const Scene scene = steepSideScene();
    Stage stage(scene);
    stage.show(0);
    // Maps of as many texels; a few of them miss what they see at a slant.
    EXPECT_NEAR(meanOnWall(stage, "layered-attenuation:n=16,map=256"), meanOnWall(stage, "sampled-maps:n=16,map=512"), 0.05);
}

TEST(LayeredAttenuation, SeesAGroundThatIsItsViewsFarPlane) {
    // Under a light parallel to the ground, and with something so near the light that the ground's window depth rounds to 1.
    Scene scene = groundScene(64);
    scene.objects[0] = object(plane(4), {0, 0, 0});
    scene.objects.push_back(object(box({0.1, 0.1, 0.1}), {0.2, 5.88, 0.1}));
    scene.light = {LightKind::Rectangle, {0, 6, 0}, {0, -1, 0}, {0.6, 0, 0}, {0, 0, 0.6}};
    Stage stage(scene);
    stage.show(0);
    // Two samples more or less, since the texels of the maps lie elsewhere; without layers all of the ground is dark.
    EXPECT_LE(differenceOnReceivers(stage, rendered(stage, "layered-attenuation"), rendered(stage, "sampled-maps")),
              1.0 / 32);
}

TEST(LayeredAttenuation, OfNSamplesHasNPlusOneValues) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    for (const float x : rendered(stage, "layered-attenuation:n=33,map=128")) EXPECT_NEAR(33 * x, std::round(33 * x), 1e-4);
}

TEST(LayeredAttenuation, HoldsTwoLayersWhereTheCentreSeesOnlyThePlate) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto figures = figuresOf(stage, "layered-attenuation:n=64,map=512");
    // The slab from the hard shadow's edge to the umbra, which some sample sees, in texels of the map. It spans the slopes
    // from the slab's end to the plate's along x, and the plate's along z.
    const double wide = (20.2 / (6 - 2.002) + 6.1 / 6) * 6 / 512, high = 40 / (6 - 2.002) * 6 / 512;
    const double rows = 12 / high, strip = (umbraFrom - hardEdge) / wide * rows;
    const double second = figures.at("layers") - figures.at("filled_texels");
    EXPECT_GE(second, strip);
    EXPECT_LE(second, strip + rows); // a texel that is seen in part counts whole
}

/// Frames of which the first two are the same.
Scene laterMoving(const Scene& still) {
    Scene scene = still;
    scene.timeline.still = 2;
    scene.timeline.moving = 2;
    return scene;
}

/// Depth maps that a technique draws in each of the frames 0 … 3.
std::vector<double> mapsByFrame(const Scene& scene) {
    Stage stage(scene);
    const auto technique = made("layered-attenuation:n=4,map=64");
    std::vector<double> maps;
    for (int frame = 0; frame < 4; ++frame) {
        stage.show(frame);
        stage.render(*technique, frame, 1);
        maps.push_back(technique->figures(stage.frame(frame, 1)).at("maps"));
    }
    return maps;
}

TEST(LayeredAttenuation, IsBuiltAgainWhenLightOrCastersMove) {
    Scene light = laterMoving(overlapScene());
    light.lightCentre.keys = {{0, light.light.centre}, {2, light.light.centre + glm::dvec3(0.5, 0, 0)}};
    EXPECT_EQ(mapsByFrame(light), (std::vector<double>{4, 0, 4, 4}));

    Scene caster = laterMoving(overlapScene());
    caster.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {1, {0.3, 0, 0}}};
    EXPECT_EQ(mapsByFrame(caster), (std::vector<double>{4, 0, 4, 0})); // at rest again

    Scene camera = laterMoving(overlapScene());
    camera.eye.keys = {{0, camera.camera.eye}, {2, camera.camera.eye + glm::dvec3(0.5, 0, 0)}};
    EXPECT_EQ(mapsByFrame(camera), (std::vector<double>{4, 0, 0, 0}));
}

TEST(LayeredAttenuation, IsTheSameAfterAMoveAsFromTheBeginning) {
    Scene scene = laterMoving(overlapScene());
    scene.lightCentre.keys = {{0, scene.light.centre}, {2, scene.light.centre + glm::dvec3(0.5, 0, 0)}};
    Stage stage(scene);
    const auto technique = made("layered-attenuation:n=8,map=128");
    stage.show(0);
    stage.render(*technique, 0, 1);
    stage.show(3);
    stage.render(*technique, 1, 1);
    const Image<float> moved = stage.visibility();
    EXPECT_EQ(moved, rendered(stage, "layered-attenuation:n=8,map=128"));
    technique->reset();
    stage.render(*technique, 2, 1);
    EXPECT_EQ(technique->figures(stage.frame(2, 1)).at("maps"), 8);
    EXPECT_EQ(stage.visibility(), moved);
}

gl::WorkCount workOf(Stage& stage, techniques::Technique& technique, int frame) {
    return timing::measurePasses(stage, technique, frame, 1, 1).frame().work;
}

TEST(LayeredAttenuation, ASteadyFrameCostsNoMoreThanAShadowMap) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const auto layered = made("layered-attenuation:n=16,map=128"), uniform = made("sm-uniform");
    stage.render(*layered, 0, 1);
    const Image<float> first = stage.visibility();
    const gl::WorkCount steady = workOf(stage, *layered, 1), map = workOf(stage, *uniform, 1);
    EXPECT_LE(static_cast<double>(steady.fragments), 1.5 * static_cast<double>(map.fragments));
    stage.render(*layered, 3, 1);
    EXPECT_EQ(stage.visibility(), first);
}

TEST(LayeredAttenuation, AFrameWithAMovedLightCostsNMaps) {
    const Scene scene = overlapScene();
    Stage stage(scene);
    stage.show(0);
    const auto building = [&](const std::string& variant) {
        const auto technique = made(variant);
        const gl::WorkCount steady = [&] {
            stage.render(*technique, 0, 1);
            return workOf(stage, *technique, 1);
        }();
        gl::WorkMeter meter;
        technique->reset();
        stage.redraw();
        stage.render(*technique, 2, 1);
        const gl::WorkCount built = meter.finish();
        return std::pair{built.draws - steady.draws, static_cast<double>(built.fragments - steady.fragments)};
    };
    const auto [fewDraws, fewFragments] = building("layered-attenuation:n=16,map=128");
    const auto [draws, fragments] = building("layered-attenuation:n=64,map=128");
    EXPECT_EQ(fewDraws, 16 * scene.objects.size());
    EXPECT_EQ(draws, 64 * scene.objects.size());
    EXPECT_NEAR(fragments / fewFragments, 4, 0.1); // samples see a little more or less of the scene
}

TEST(LayeredAttenuation, RefusesBadInput) {
    for (const char* wrong : {"layered-attenuation:n=0", "layered-attenuation:n=257", "layered-attenuation:map=4096",
                              "layered-attenuation:oversampling=0", "layered-attenuation:thickness=0"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
}

} // namespace
} // namespace shadowbench
