// Shadow volumes counted in the stencil buffer: where each way of counting is exact, and where it is known to break.
#include "base/random.h"
#include "techniques/catalog.h"
#include "tests/support/ground_labels.h"
#include "tests/support/ground_score.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// The eye between slab and box, in the box's shadow.
Scene eyeInShadow() {
    Scene scene = boxScene();
    scene.light.centre = {0.13, 9, 0.21};
    scene.camera.eye = {0.2, 0.6, 0.3};
    scene.camera.target = {2.5, 0, 0.4};
    scene.camera.near = 0.01;
    return scene;
}

/// The slab under `count` thin plates of 1 × 1 m, 1 mm apart from 1 m up, the light right above them.
Scene pileScene(int count) {
    Scene scene = groundScene(96);
    scene.light.centre = {0.2, 6.1, 0.3};
    Object pile = object(box({1, 0.0002, 1}), {0, 0, 0});
    pile.instances.clear();
    for (int i = 0; i < count; ++i)
        pile.instances.push_back({glm::translate(glm::dmat4(1), glm::dvec3(0.2, 1 + 0.001 * i, 0.3)), 0});
    scene.objects.push_back(pile);
    return scene;
}

/// The pile's shadow is that of the highest plate, the nearest to the light, a square about the light's foot; the others'
/// lie within it.
bool inPileShadow(const glm::dvec3& p, int count) {
    const double height = 1.0001 + 0.001 * (count - 1);
    const double half = 0.5 * 6.1 / (6.1 - height);
    return std::max(std::abs(p.x - 0.2), std::abs(p.z - 0.3)) < half;
}

class EveryWayOfCounting : public testing::TestWithParam<const char*> {};

TEST_P(EveryWayOfCounting, ABoxsShadowIsTheExactPolygonToATwentiethOfAPixel) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, GetParam()), behindBox(scene));
    EXPECT_GT(labels.dark, 1000U);
    EXPECT_EQ(labels.mismatch(), 0);
}

TEST_P(EveryWayOfCounting, HoldsUnderADirectionalLight) {
    Scene scene = boxScene(128);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-0.3, -1, 0.4));
    scene.light = {LightKind::Directional, {}, direction, {}, {}};
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, GetParam());
    const auto shadowed = [&](const glm::dvec3& p) { return meetsBox(p, p - 1e4 * direction); };
    EXPECT_EQ(compareOnGround(scene, stage, v, shadowed).mismatch(), 0);
}

std::string idOf(const testing::TestParamInfo<const char*>& tested) {
    std::string name = tested.param;
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Volumes, EveryWayOfCounting,
                         testing::Values("volume-zpass", "volume-zfail", "volume-xor", "sm-zpp"), idOf);

TEST(VolumeZpass, InvertsWithTheEyeInShadow) { // Zápotocký 2.4.3, remark; course, Everitt–Kilgard 2.2
    const Scene scene = eyeInShadow();
    Stage stage(scene);
    stage.show(0);
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, "volume-zpass"), behindBox(scene));
    EXPECT_GT(labels.lit, 500U);
    EXPECT_GT(labels.dark, 500U);
    EXPECT_EQ(labels.mismatch(), 1);
}

TEST(SmZpp, HoldsWithTheEyeInShadow) { // Hornus et al. 2005
    const Scene scene = eyeInShadow();
    Stage stage(scene);
    stage.show(0);
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, "sm-zpp"), behindBox(scene));
    EXPECT_GT(labels.lit, 500U);
    EXPECT_GT(labels.dark, 500U);
    EXPECT_EQ(labels.mismatch(), 0);
}

TEST(VolumeXor, InvertsWithTheEyeInShadow) {
    const Scene scene = eyeInShadow();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(compareOnGround(scene, stage, rendered(stage, "volume-xor"), behindBox(scene)).mismatch(), 1);
}

TEST(VolumeXor, LosesAShadowThatTwoCastersShare) { // Zápotocký 2.4.5
    const Scene scene = pileScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto shadowed = [](const glm::dvec3& p) { return inPileShadow(p, 2); };
    const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, "volume-xor"), shadowed);
    EXPECT_GT(labels.dark, 100U);
    EXPECT_GT(labels.leak, 0.9 * static_cast<double>(labels.dark)); // but for the rim that one plate alone shades
    EXPECT_EQ(labels.falseShadow, 0U);
    EXPECT_EQ(compareOnGround(scene, stage, rendered(stage, "volume-zpass"), shadowed).mismatch(), 0);
}

class PileOfPlates : public testing::TestWithParam<int> {};

TEST_P(PileOfPlates, IsAsDarkAsOnePlate) { // an 8-bit count of 256 or 512 is none
    const Scene scene = pileScene(GetParam());
    Stage stage(scene);
    stage.show(0);
    const auto shadowed = [](const glm::dvec3& p) { return inPileShadow(p, GetParam()); };
    for (const char* variant : {"volume-zfail", "volume-zpass", "volume-zfail:far=infinity", "sm-zpp"}) {
        const GroundLabels labels = compareOnGround(scene, stage, rendered(stage, variant), shadowed);
        EXPECT_GT(labels.dark, 100U) << variant;
        EXPECT_EQ(labels.mismatch(), 0) << variant;
    }
}

INSTANTIATE_TEST_SUITE_P(Volumes, PileOfPlates, testing::Values(255, 256, 257, 512));

TEST(VolumeZfail, CapsHoldWhereTheFarPlaneCutsTheirSurface) {
    // The ground reaches beyond the far plane: its depth is that of a clipped polygon, its cap's is not. Exact but for a
    // pixel on an edge.
    EXPECT_LE(mismatchOn(1, avenueScene(0.5), "volume-zfail"), 5e-5);
    EXPECT_LE(mismatchOn(1, avenueScene(0.01), "volume-zfail"), 5e-5);
}

TEST(VolumeZfail, LeaksWhereAnOpenMeshLeavesItsVolumeOpenAtInfinity) { // course, Everitt–Kilgard 3.1: closed models
    Scene scene = groundScene();
    scene.light.centre = {0.2, 6.1, 0.3};
    scene.camera.eye = {0.9, 5.2, 1.1}; // most rays end in the directions of the light's own
    scene.camera.target = {0.5, 0, 0.6};
    scene.objects.push_back(object(plane(0.5), {0.6, 1.5, 0.7}));
    Stage stage(scene);
    stage.show(0);
    const auto shadowed = [](const glm::dvec3& p) {
        const double scale = 6.1 / (6.1 - 1.5); // of the sheet's shadow about the light's foot
        return std::max(std::abs(p.x - 0.2 - scale * 0.4), std::abs(p.z - 0.3 - scale * 0.4)) < scale * 0.5;
    };
    EXPECT_GT(compareOnGround(scene, stage, rendered(stage, "volume-zfail"), shadowed).mismatch(), 0.05);
    EXPECT_EQ(compareOnGround(scene, stage, rendered(stage, "volume-zpass"), shadowed).mismatch(), 0);
}

/// A volume grows from the edges of what faces the light. Course, Everitt–Kilgard 3.1: closed models.
TEST(ShadowVolumes, LoseASheetThatTurnsItsBackToTheLight) {
    Scene scene = groundScene();
    scene.light.centre = {0.2, 6.1, 0.3};
    Mesh sheet = plane(0.5);
    for (glm::uvec3& t : sheet.triangles) std::swap(t.y, t.z);
    scene.objects.push_back(object(sheet, {0.6, 1.5, 0.7}));
    Stage stage(scene);
    stage.show(0);
    const auto lit = [](const glm::dvec3&) { return false; };
    for (const char* technique : {"volume-zpass", "volume-xor", "volume-zfail", "sm-zpp"}) {
        EXPECT_EQ(compareOnGround(scene, stage, rendered(stage, technique), lit).mismatch(), 0) << technique;
        EXPECT_TRUE(techniques::entryNamed(technique).lacks.contains(techniques::Need::OpenMeshes)) << technique;
    }
}

Mesh rounded(Mesh mesh) {
    for (glm::vec3& position : mesh.positions) position = glm::round(1024.0F * position) / 1024.0F;
    return mesh;
}

/// The slab under casters of all kinds, some beyond the far plane and behind the eye, from a place among them.
Scene crowdScene(Random& random) {
    Scene scene = groundScene(96);
    const auto grid = [&](double reach) { return std::round(64 * random.uniform(-reach, reach)) / 64; };
    for (int i = 0; i < 24; ++i) {
        // On multiples of 1/64 m, where 32-bit sums are exact.
        const glm::dvec3 at(grid(6), 1 + std::abs(grid(3)), grid(6));
        scene.objects.push_back(object(i % 3 == 0 ? rounded(bumpy(0.4, 0.2, 200, 3)) : box({0.5, 0.25, 0.75}), at));
    }
    scene.light.centre = {grid(5), 6 + grid(1), grid(5)};
    if (random.uniform() < 0.5)
        scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(grid(1), -1, grid(1))), {}, {}};
    scene.camera.eye = {grid(5), 0.25 + std::abs(grid(2)), grid(5)};
    scene.camera.target = {grid(5), 0, grid(5)};
    scene.camera.near = random.uniform() < 0.5 ? 0.01 : 1.5;
    scene.camera.far = random.uniform() < 0.5 ? 4 : 40;
    return scene;
}

/// The same surfaces as one mesh, whose volume is never left out.
Scene asOneCaster(const Scene& scene) {
    Mesh all;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = *object.levels.front().mesh;
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const glm::vec3& position : mesh.positions)
            all.positions.push_back(position + glm::vec3(object.instances.front().place[3]));
        for (const glm::uvec3& triangle : mesh.triangles) all.triangles.push_back(triangle + first);
    }
    all.closed = true;
    Scene one = scene;
    one.objects = {object(all, {0, 0, 0})};
    return one;
}

TEST(Volumes, ThatAreLeftOutAndTheChoiceOfTestChangeNoPixel) {
    Random random(5);
    double culled = 0, byDepthFail = 0, byDepthPass = 0;
    for (int i = 0; i < 40; ++i) {
        const Scene scene = crowdScene(random), one = asOneCaster(scene);
        Stage stage(scene), whole(one);
        stage.show(0);
        whole.show(0);
        for (const std::string far : {"clamp", "infinity"}) {
            const Image<float> all = rendered(whole, "volume-zfail:test=zfail,far=" + far);
            EXPECT_EQ(rendered(stage, "volume-zfail:test=zfail,far=" + far), all) << i;
            EXPECT_EQ(rendered(stage, "volume-zfail:far=" + far), all) << i;
        }
        for (const char* variant : {"volume-zpass", "volume-xor"})
            EXPECT_EQ(rendered(stage, variant), rendered(whole, variant)) << variant << " " << i;
        const auto figures = figuresOf(stage, "volume-zfail");
        culled += figures.at("volumes_culled");
        byDepthFail += figures.at("volumes_by_depth_fail");
        byDepthPass += 25 - figures.at("volumes_culled") - figures.at("volumes_by_depth_fail");
    }
    EXPECT_GT(culled, 300); // of 40 · 25
    EXPECT_GT(byDepthFail, 10);
    EXPECT_GT(byDepthPass, 200);
}

/// The crowd from a place where the near plane is large and cuts shadows.
Scene cutCrowdScene(Random& random) {
    Scene scene = crowdScene(random);
    scene.camera.near = 1.5;
    scene.size = {512, 512};
    return scene;
}

// The last pixels of a side that the near plane cuts and of its cap are rasterised from different vertices: one in a million
// is counted twice, or not at all. Which, the rasteriser decides: the bound is twice as many.
TEST(SmZpp, CountsAsDepthFailButForStrayPixelsWhereTheNearPlaneCutsASide) {
    Random random(5);
    std::size_t stray = 0, ofDepthPass = 0;
    for (int i = 0; i < 40; ++i) {
        const Scene scene = cutCrowdScene(random);
        Stage stage(scene);
        stage.show(0);
        const Image<float> exact = rendered(stage, "volume-zfail:test=zfail");
        stray += differing(rendered(stage, "sm-zpp"), exact);
        ofDepthPass += differing(rendered(stage, "volume-zpass"), exact);
    }
    EXPECT_GT(ofDepthPass, 500'000U); // of 40 · 512²
    EXPECT_LE(stray, 20U);
}

TEST(SmZpp, LosesTheShadowOfASheetThatFacesAway) { // it has no triangle that faces the light
    Scene scene = groundScene();
    Mesh sheet = plane(0.7);
    scene.objects.push_back(object(sheet, {0.13, 1.0, 0.21}));
    Stage towards(scene);
    towards.show(0);
    EXPECT_LE(differing(rendered(towards, "sm-zpp"), rendered(towards, "sm-alias-free")), 3U); // on an edge, to rounding
    for (glm::uvec3& triangle : sheet.triangles) std::swap(triangle.y, triangle.z);
    scene.objects.back() = object(sheet, {0.13, 1.0, 0.21});
    Stage away(scene);
    away.show(0);
    const Image<float> lost = rendered(away, "sm-zpp"), exact = rendered(away, "sm-alias-free");
    EXPECT_GT(differing(lost, exact), 100U);
}

TEST(SmZpp, DrawsCapsOfCastersWhoseShadowTheNearPlaneCutsAlone) {
    const Scene lit = boxScene(), shaded = eyeInShadow();
    Stage outside(lit), inside(shaded);
    outside.show(0);
    inside.show(0);
    for (const char* figure : {"volume_triangles", "stencil_updates"})
        EXPECT_EQ(figuresOf(outside, "sm-zpp").at(figure), figuresOf(outside, "volume-zpass").at(figure));
    const auto pass = figuresOf(inside, "volume-zpass"), near = figuresOf(inside, "sm-zpp");
    EXPECT_EQ(near.at("volume_triangles"), pass.at("volume_triangles") + 2); // the box's top
    EXPECT_LT(near.at("volume_triangles"), figuresOf(inside, "volume-zfail:test=zfail").at("volume_triangles"));
}

TEST(VolumeZfail, CountsByDepthPassButForCastersWhoseShadowTheNearPlaneCuts) { // course, Everitt–Kilgard 3.4
    const Scene lit = boxScene(), shaded = eyeInShadow();
    Stage outside(lit), inside(shaded);
    outside.show(0);
    inside.show(0);
    EXPECT_EQ(figuresOf(outside, "volume-zfail").at("volumes_by_depth_fail"), 0);
    EXPECT_EQ(figuresOf(outside, "volume-zfail:test=zfail").at("volumes_by_depth_fail"), 2);
    EXPECT_EQ(figuresOf(outside, "volume-zfail").at("volume_fragments"),
              figuresOf(outside, "volume-zpass").at("volume_fragments"));
    EXPECT_EQ(figuresOf(inside, "volume-zfail").at("volumes_by_depth_fail"), 1); // the box, not the slab
}

/// The box right below the eye, under a light from straight above: volumes' sides run from the outlines of the slab, which
/// is larger than the image, and of the box to the image's middle, and are hidden by slab and box.
Scene sceneFromAbove() {
    Scene scene = boxScene();
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 45, 0.5, 40};
    return scene;
}

TEST(VolumeFigures, CountEveryFragmentAndTheUpdatesAmongThem) {
    const Scene scene = sceneFromAbove();
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const auto ofBox = std::count(drawn.id.begin(), drawn.id.end(), 2U);
    const double sides = static_cast<double>(drawn.id.size()) + static_cast<double>(ofBox); // each covers its outline once
    const auto pass = figuresOf(stage, "volume-zpass"), fail = figuresOf(stage, "volume-zfail:test=zfail");
    EXPECT_EQ(pass.at("volume_triangles"), 8); // a triangle a top edge: the volumes end in a point
    EXPECT_EQ(pass.at("volume_fragments"), sides);
    EXPECT_EQ(pass.at("stencil_updates"), 0);
    EXPECT_EQ(pass.at("stencil_bytes"), 4 * sides);
    EXPECT_EQ(fail.at("volume_triangles"), 8 + 4); // the tops close them at the front
    EXPECT_EQ(fail.at("volume_fragments"), 2 * sides);
    EXPECT_EQ(fail.at("stencil_updates"), 2 * sides); // all lies behind what is seen
    EXPECT_EQ(fail.at("stencil_bytes"), 4 * (2 * sides + 2 * sides));
}

TEST(VolumeFigures, LeaveTheImageAndTheNextOneAsTheyAre) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    for (const char* name :
         {"volume-zpass", "volume-zfail", "volume-zfail:test=zfail,far=infinity", "volume-xor", "sm-zpp"}) {
        const Image<float> untouched = rendered(stage, name);
        const auto figures = figuresOf(stage, name);
        EXPECT_EQ(stage.visibility(), untouched) << name;
        EXPECT_GT(figures.at("stencil_updates"), 0) << name;
        EXPECT_EQ(rendered(stage, name), untouched) << name;
        EXPECT_EQ(figuresOf(stage, name), figures) << name;
    }
    EXPECT_EQ(figuresOf(stage, "volume-xor"), figuresOf(stage, "volume-zpass")); // the same sides and test
}

} // namespace
} // namespace shadowbench
