#include "base/error.h"
#include "groundtruth/oracle.h"
#include "scene/sky.h"
#include "tests/support/povray_scene.h"

#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <type_traits>

namespace shadowbench::groundtruth {
namespace {

Request soft() { return {overlappingPlates(), {64, 48}}; }

Request hard() {
    Request request = soft();
    request.truth = Truth::Hard;
    return request;
}

const Tools tools{{"povray", "3.7"}, {"exact", "1"}};

std::string keyAfter(Request request, const std::function<void(Request&)>& change) {
    change(request);
    return key(request, tools);
}

Mesh& ownMesh(Request& request, std::size_t batch) {
    auto copy = std::make_shared<Mesh>(*request.snapshot.batches[batch].mesh);
    Mesh& mesh = *copy;
    request.snapshot.batches[batch].mesh = std::move(copy);
    return mesh;
}

TEST(ReferenceKey, IsOfTheUsualTruthOfTheSnapshotsLight) {
    static_assert(!std::is_default_constructible_v<Request>); // the truth of no light, or of another one
    EXPECT_EQ(soft().truth, Truth::Soft);
    EXPECT_EQ(Request(hard().snapshot, {64, 48}).truth, Truth::Soft);
    Snapshot centre = soft().snapshot;
    centre.light = centre.light.centreOnly();
    EXPECT_EQ(Request(centre, {64, 48}).truth, Truth::Hard);
    EXPECT_EQ(key(Request(centre, {64, 48}), tools), key(hard(), tools));
}

TEST(ReferenceKey, IsThirtyTwoHexDigitsAndTheSameEachTime) {
    EXPECT_EQ(key(soft(), tools).size(), 32U);
    EXPECT_EQ(key(soft(), tools).find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(key(soft(), tools), key(soft(), tools));
}

TEST(ReferenceKey, ChangesWithEverythingThatMattersToTheTruth) {
    const std::vector<std::pair<const char*, std::function<void(Request&)>>> changes{
        {"eye", [](Request& r) { r.snapshot.camera.eye.x += 1e-9; }},
        {"target", [](Request& r) { r.snapshot.camera.target.z += 1e-9; }},
        {"far plane", [](Request& r) { r.snapshot.camera.far += 1; }},
        {"field of view", [](Request& r) { r.snapshot.camera.fovy = 41; }},
        {"light kind", [](Request& r) { r.snapshot.light.kind = LightKind::Disk; }},
        {"light side", [](Request& r) { r.snapshot.light.u.x *= 2; }},
        {"the light's other side", [](Request& r) { r.snapshot.light.v *= 2; }},
        {"the light's place", [](Request& r) { r.snapshot.light.centre.y += 1e-9; }},
        {"vertex", [](Request& r) { ownMesh(r, 1).positions[3].y += 0.001F; }},
        {"triangle",
         [](Request& r) {
             Mesh& mesh = ownMesh(r, 1);
             std::swap(mesh.triangles[0], mesh.triangles[1]);
         }},
        {"placement", [](Request& r) { r.snapshot.batches[1].placements[1].world[3].z += 0.5; }},
        {"id", [](Request& r) { r.snapshot.batches[1].placements[1].id = 9; }},
        {"a placement less", [](Request& r) { r.snapshot.batches[1].placements.pop_back(); }},
        {"width", [](Request& r) { r.size.x = 65; }},
        {"sides swapped", [](Request& r) { std::swap(r.size.x, r.size.y); }},
        {"samples", [](Request& r) { r.samples = 256; }},
        {"exact shares", [](Request& r) { r.truth = Truth::Area; }},
        {"pixel areas", [](Request& r) { r.truth = Truth::PixelArea; }},
    };
    for (const auto& [what, change] : changes) EXPECT_NE(keyAfter(soft(), change), key(soft(), tools)) << what;
    EXPECT_NE(key(hard(), tools), key(soft(), tools));
    EXPECT_NE(keyAfter(hard(), [](Request& r) { r.oracle = Oracle::Rays; }), key(hard(), tools));
}

Request underSky(EnvironmentLight environment) {
    Request request = soft();
    request.snapshot.light = environmentLight(std::move(environment));
    return request;
}

TEST(ReferenceKey, OfAnEnvironmentChangesWithAllThatLights) {
    ImageSky image{Image<float>(8, 4, 1)};
    const EnvironmentLight plain{image, {Sun{{0, 1, 0}, 5, 10}}};
    const std::string before = key(underSky(plain), tools);
    EXPECT_EQ(key(underSky(plain), tools), before); // of another copy of the same image

    image.radiance(3, 2) = 1.0001F;
    const std::vector<EnvironmentLight> others{{image, plain.suns},
                                               {ConstantSky{1}, plain.suns},
                                               {ConstantSky{2}, plain.suns},
                                               {HarmonicSky{{1}}, plain.suns},
                                               {HarmonicSky{{1, 0, 0, 0}}, plain.suns},
                                               {plain.sky, {}},
                                               {plain.sky, {Sun{{1, 0, 0}, 5, 10}}},
                                               {plain.sky, {Sun{{0, 1, 0}, 6, 10}}},
                                               {plain.sky, {Sun{{0, 1, 0}, 5, 11}}},
                                               {plain.sky, {plain.suns[0], plain.suns[0]}}};
    std::set<std::string> keys{before, key(soft(), tools)};
    for (const EnvironmentLight& other : others) keys.insert(key(underSky(other), tools));
    EXPECT_EQ(keys.size(), others.size() + 2);
    Request finer = underSky(plain);
    finer.samples = 4096;
    EXPECT_NE(key(finer, tools), before);
}

TEST(ReferenceKey, ChangesWithEveryToolVersion) {
    EXPECT_NE(key(soft(), {{"povray", "3.8"}, {"exact", "1"}}), key(soft(), tools));
    EXPECT_NE(key(soft(), {{"povray", "3.7"}, {"exact", "2"}}), key(soft(), tools));
    const Tools ofSoft = toolVersions(soft()), ofHard = toolVersions(hard());
    EXPECT_TRUE(ofSoft.contains("povray") && ofSoft.contains("povray recipe") && ofSoft.contains("exact"));
    EXPECT_TRUE(ofHard.contains("cgal") && ofHard.contains("exact") && !ofHard.contains("povray"));
}

TEST(ReferenceKey, DoesNotChangeWithWhatTheTruthCannotSee) {
    const std::vector<std::pair<const char*, std::function<void(Request&)>>> changes{
        {"colour", [](Request& r) { r.snapshot.batches[1].colour = glm::vec3(0.1F); }},
        {"previous matrix", [](Request& r) { r.snapshot.batches[1].placements[0].previous[3].x = 5; }},
        {"moving flag", [](Request& r) { r.snapshot.batches[1].moving = true; }},
        {"frame number", [](Request& r) { r.snapshot.frame = 17; }},
        {"previous camera", [](Request& r) { r.snapshot.previousCamera.eye.x = 5; }},
        {"mesh copied", [](Request& r) { ownMesh(r, 1); }},
        {"batch order", [](Request& r) { std::swap(r.snapshot.batches[0], r.snapshot.batches[1]); }},
        {"placement order",
         [](Request& r) { std::swap(r.snapshot.batches[1].placements[0], r.snapshot.batches[1].placements[1]); }},
        {"negative zero", [](Request& r) { r.snapshot.batches[1].placements[0].world[3].x = -0.0; }},
    };
    for (const auto& [what, change] : changes) EXPECT_EQ(keyAfter(soft(), change), key(soft(), tools)) << what;
}

TEST(ReferenceKey, HardShadowsDoNotDependOnTheNumberOfSamples) {
    EXPECT_EQ(keyAfter(hard(), [](Request& r) { r.samples = 7; }), key(hard(), tools));
}

TEST(ReferenceKey, OfEveryExactShareIsItsOwnAndDoesNotDependOnTheNumberOfSamples) {
    std::set<std::string> keys{key(soft(), tools)};
    for (const Truth truth : {Truth::Area, Truth::Irradiance, Truth::SolidAngle}) {
        Request request = soft();
        request.truth = truth;
        keys.insert(key(request, tools));
        request.samples = 7;
        keys.insert(key(request, tools));
        EXPECT_FALSE(toolVersions(request).contains("povray"));
        EXPECT_EQ(toolVersions(request).contains("area weights"), truth != Truth::Area);
    }
    EXPECT_EQ(keys.size(), 4U);
}

TEST(ReferenceKey, NeedsPovRayForAreaLightsOnly) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nonexistent", 1);
    EXPECT_THROW(key(soft()), Inconclusive);
    EXPECT_NO_THROW(key(hard()));
    setenv("PATH", path.c_str(), 1);
}

TEST(OracleNames, GoThereAndBack) {
    for (const Oracle oracle : {Oracle::Auto, Oracle::Polygon, Oracle::Rays, Oracle::Plan})
        EXPECT_EQ(oracleNamed(name(oracle)), oracle);
    for (const Truth truth : {Truth::Hard, Truth::Soft, Truth::PixelArea, Truth::Area, Truth::Irradiance, Truth::SolidAngle})
        EXPECT_EQ(truthNamed(name(truth)), truth);
}

TEST(OracleNames, AnUnknownOneNamesItsNearMatchAndAllValidOnes) {
    try {
        oracleNamed("poligon");
        FAIL() << "poligon is no oracle";
    } catch (const BadInput& error) {
        for (const char* part : {"\"poligon\"", "did you mean \"polygon\"?", "auto, polygon, rays, plan"})
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace shadowbench::groundtruth
