// Axes of sweeps, and what is read off their curves.
#include "base/error.h"
#include "report/run_report.h"
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "scene/sky.h"
#include "studies/sweep/axis.h"
#include "studies/sweep/sweep.h"
#include "studies/sweep/tessellate.h"
#include "tests/support/message_of.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench {
namespace {

double area(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

TEST(Tessellation, QuartersEveryTriangleAndKeepsAClosedMeshClosed) {
    const Mesh whole = box({2, 1, 3});
    const Mesh fine = quartered(whole, 3);
    EXPECT_EQ(fine.triangles.size(), whole.triangles.size() * 64);
    EXPECT_TRUE(fine.closed);
    EXPECT_NO_THROW(requireWellFormed(fine, "box"));
    EXPECT_DOUBLE_EQ(area(fine), area(whole)); // halves of a box's coordinates are exact
    EXPECT_EQ(quartered(whole, 0).triangles, whole.triangles);
}

double angleToEye(const Scene& scene) {
    const glm::dvec3 eye = scene.camera.eye - scene.camera.target;
    const glm::dvec3 light =
        scene.light.kind == LightKind::Directional ? -scene.light.direction : scene.light.centre - scene.camera.target;
    return glm::degrees(std::atan2(glm::length(glm::cross(eye, light)), glm::dot(eye, light)));
}

TEST(Axes, ALightGoesFromAnEighthToTwiceItsSize) {
    const std::vector<double> sizes = axisNamed("light-size").values;
    EXPECT_EQ(sizes.front(), 0.125);
    EXPECT_EQ(sizes.back(), 2);
    EXPECT_NE(std::ranges::find(sizes, 1), sizes.end()) << "the scene's own";
}

TEST(Axes, ALightViewAngleOfZeroIsAMinersHeadlampAndOneOf180FacesTheCamera) {
    for (const std::string id : {"dueling-frusta", "overlapping-occluders", "windmills"}) {
        Scene scene = loadScene(id, Profile::Gate);
        const glm::dvec3 target = scene.camera.target;
        const double distance = glm::distance(scene.light.centre, target);
        axisNamed("light-view-angle").move(scene, 0);
        EXPECT_NEAR(angleToEye(scene), 0, 1e-9) << id;
        if (scene.light.kind != LightKind::Directional) {
            EXPECT_NEAR(glm::distance(scene.light.centre, target), distance, 1e-9);
        }

        axisNamed("light-view-angle").move(scene, 180);
        const glm::dvec3 eye = scene.camera.eye - target;
        const double elevation = glm::degrees(std::atan2(eye.y, glm::length(glm::dvec2(eye.x, eye.z))));
        EXPECT_NEAR(angleToEye(scene), 180 - 2 * elevation, 1e-9) << id; // both stay above the ground
    }
}

TEST(Axes, AFacingAngleIsThatOfTheTwoAxesWhileTheCameraStays) {
    for (const std::string id : {"dueling-frusta", "overlapping-occluders", "windmills"}) {
        Scene scene = loadScene(id, Profile::Gate);
        const Camera camera = scene.camera;
        const Axis& axis = axisNamed("facing-angle");
        const double widest = axis.most(scene);
        for (const double degrees : {0.0, 60.0, 139.0, widest}) {
            axis.move(scene, degrees);
            EXPECT_NEAR(angleToEye(scene), degrees, 1e-6) << id;
        }
        const glm::dvec3 light =
            scene.light.kind == LightKind::Directional ? -scene.light.direction : scene.light.centre - camera.target;
        EXPECT_NEAR(light.y, 0, 1e-9) << id; // level with what the camera looks at
        EXPECT_EQ(scene.camera, camera);
        EXPECT_THROW(axis.move(scene, widest + 1), BadInput) << id;
        EXPECT_THROW(axis.move(scene, -1), BadInput) << id;
    }
}

TEST(Axes, AnElevationTurnsTheLightInItsOwnBearingAndAnAreaLightKeepsItsShape) {
    Scene scene = loadScene("overlapping-occluders", Profile::Gate);
    const Light before = scene.light;
    axisNamed("light-elevation").move(scene, 30);
    const glm::dvec3 was = before.centre - scene.camera.target, is = scene.light.centre - scene.camera.target;
    EXPECT_NEAR(glm::degrees(std::asin(is.y / glm::length(is))), 30, 1e-9);
    EXPECT_NEAR(was.x * is.z, was.z * is.x, 1e-9);
    EXPECT_NEAR(glm::length(scene.light.u), glm::length(before.u), 1e-12);
    EXPECT_NEAR(glm::dot(scene.light.u, scene.light.v), glm::dot(before.u, before.v), 1e-12);
    const glm::dvec3 faceBefore = glm::cross(before.u, before.v), faceNow = glm::cross(scene.light.u, scene.light.v);
    EXPECT_NEAR(glm::dot(faceNow, is) / glm::length(is), glm::dot(faceBefore, was) / glm::length(was), 1e-9);
}

TEST(Axes, ALightSizeScalesBothSidesOfTheScenesLightAboutItsCentre) {
    Scene scene = loadScene("large-light", Profile::Gate);
    const Light before = scene.light;
    axisNamed("light-size").move(scene, 0.5);
    EXPECT_EQ(scene.light.centre, before.centre);
    EXPECT_EQ(scene.light.u, 0.5 * before.u);
    EXPECT_EQ(scene.light.v, 0.5 * before.v);
    EXPECT_THROW(axisNamed("light-size").move(scene, 0), BadInput);
}

TEST(Axes, ASunBringsTheSameWhateverItsSize) {
    Scene scene = loadScene("sun-in-sky", Profile::Gate);
    const EnvironmentLight before = *scene.light.environment;
    axisNamed("sun-size").move(scene, 40);
    const EnvironmentLight& now = *scene.light.environment;
    EXPECT_EQ(now.sky, before.sky);
    EXPECT_EQ(now.suns[0].diameter, 40);
    EXPECT_EQ(now.suns[0].direction, before.suns[0].direction);
    EXPECT_NEAR(now.suns[0].radiance * now.suns[0].solidAngle(), before.suns[0].radiance * before.suns[0].solidAngle(),
                1e-9);
    EXPECT_EQ(before.suns[0].diameter, axisNamed("sun-size").values.back()); // the scene's own is the hardest
    for (const double degrees : {0.0, 181.0}) EXPECT_THROW(axisNamed("sun-size").move(scene, degrees), BadInput);
}

TEST(Axes, OfALocalLightDoNotMoveAnEnvironment) {
    Scene scene = loadScene("sun-in-sky", Profile::Gate);
    for (const char* axis : {"light-size", "light-elevation", "light-view-angle"})
        EXPECT_THROW(axisNamed(axis).move(scene, 30), BadInput) << axis;
    for (const char* id : {"constant-sky", "basic"}) {
        Scene without = loadScene(id, Profile::Gate);
        EXPECT_THROW(axisNamed("sun-size").move(without, 20), BadInput) << id;
    }
}

TEST(Axes, CastersAreCountedWithoutTheGround) {
    Scene scene = loadScene("dueling-frusta", Profile::Gate);
    axisNamed("casters").move(scene, 5);
    ASSERT_EQ(scene.objects.size(), 3U); // ground, four slabs, one column
    EXPECT_EQ(scene.objects[1].instances.size(), 4U);
    EXPECT_EQ(scene.objects[2].instances.size(), 1U);
    EXPECT_THROW(axisNamed("casters").move(scene, 6), BadInput);
}

TEST(Axes, CasterCountsEndWithAllThatTheSceneHas) {
    EXPECT_EQ(axisNamed("casters").valuesFor(loadScene("depth-complexity", Profile::Gate)),
              (std::vector<double>{1, 2, 4, 7}));
    EXPECT_EQ(axisNamed("near-plane").valuesFor(loadScene("depth-complexity", Profile::Gate)),
              axisNamed("near-plane").values);
}

TEST(Axes, ACameraThatTurnsEndsWhereTheSceneHasItAtAnEvenPace) {
    Scene scene = loadScene("turned-camera", Profile::Gate); // which has a path of its own
    const auto view = [&](int frame) {
        const Camera camera = snapshot(scene, frame).camera;
        EXPECT_EQ(camera.eye, scene.camera.eye);
        return glm::normalize(camera.target - camera.eye);
    };
    const glm::dvec3 atRest = glm::normalize(scene.camera.target - scene.camera.eye);
    axisNamed("turn").move(scene, 90);
    EXPECT_EQ(scene.timeline.approach, 30);
    for (const int frame : {0, 20}) EXPECT_LT(glm::distance(view(frame), atRest), 1e-9);
    for (const int frame : {-30, -20, -10}) {
        const glm::dvec3 flat(view(frame).x, 0, view(frame).z), end(atRest.x, 0, atRest.z);
        EXPECT_NEAR(view(frame).y, atRest.y, 1e-9) << "turns about the vertical";
        EXPECT_NEAR(glm::dot(glm::normalize(flat), glm::normalize(end)), std::cos(glm::radians(-3.0 * frame)), 1e-9);
    }
}

TEST(Axes, WhatASceneLacksIsAnError) {
    Scene scene = loadScene("dueling-frusta", Profile::Gate);
    EXPECT_THROW(axisNamed("light-size").move(scene, 2), BadInput);
    EXPECT_THROW(axisNamed("near-plane").move(scene, 0), BadInput);
    EXPECT_THROW(axisNamed("near-plane").move(scene, scene.camera.far), BadInput);
    scene.light.centre = scene.camera.target + glm::dvec3(0, 7, 0);
    EXPECT_THROW(axisNamed("light-elevation").move(scene, 30), BadInput);
    try {
        axisNamed("near-plan");
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"near-plane\"?"), std::string::npos) << error.what();
    }
}

std::vector<Record> curve(const std::vector<std::pair<double, double>>& points) {
    std::vector<Record> records;
    for (const auto& [value, error] : points) {
        Record record = test::hardRecord(); // tolerates a mismatch of 0.005
        record.values["accuracy.mismatch"] = error;
        record.sweep = SweepStep{"near-plane", "m", "sm-psm", value, {}};
        records.push_back(record);
    }
    return records;
}

TEST(Axes, OfMapsHaveEveryPowerOfTwo) {
    const std::vector<double> sides = axisNamed("map").valuesFor(loadScene("dueling-frusta", Profile::Gate));
    EXPECT_EQ(sides.front(), 4096);
    for (std::size_t i = 1; i < sides.size(); ++i) EXPECT_EQ(sides[i], sides[i - 1] / 2);
    EXPECT_EQ(sides.back(), 64);
}

TEST(Axes, OfScenesGoFromHarmlessToHard) {
    const Scene scene = loadScene("dueling-frusta", Profile::Gate);
    for (const auto& [axis, values] :
         std::map<std::string, std::vector<double>>{{"light-elevation", {85, 75, 60, 45, 30, 20, 15, 10, 7, 5}},
                                                    {"sun-size", {40, 20, 5}},
                                                    {"still-frames", {1, 2, 4, 8, 15, 30, 60, 120, 240}},
                                                    {"tessellation", {4, 3, 2, 1, 0}}})
        EXPECT_EQ(axisNamed(axis).valuesFor(scene), values) << axis;
}

TEST(Axes, OfBiasesGrowBySteadyFactors) {
    for (const auto& [axis, first, factor] : {std::tuple{"units", 4.0, 4.0}, {"factor", 0.25, 2.0}}) {
        const std::vector<double> biases = axisNamed(axis).valuesFor(loadScene("dueling-frusta", Profile::Gate));
        EXPECT_EQ(biases[0], 0) << axis;
        EXPECT_EQ(biases[1], first) << axis;
        for (std::size_t i = 2; i < biases.size(); ++i) EXPECT_EQ(biases[i], factor * biases[i - 1]) << axis;
    }
}

TEST(Sweep, IsOfTechniquesThatHaveTheParameter) {
    SweepOptions options;
    options.scene = "dueling-frusta";
    options.axis = "map";
    options.values = {-1};
    options.techniques = {"volume-zfail"};
    EXPECT_EQ(test::messageOf<BadInput>([&] { sweep(options); }),
              "none of the chosen techniques has a parameter \"map\": choose other techniques, or another axis");
    options.techniques = {"volume-zfail", "sm-uniform"};
    const std::string refused = test::messageOf([&] { sweep(options); });
    EXPECT_NE(refused.find("map"), std::string::npos) << refused;
    EXPECT_EQ(refused.find("none of"), std::string::npos) << refused;
    options.axis = "rays";
    EXPECT_EQ(test::messageOf<BadInput>([&] { sweep(options); }),
              "none of the chosen techniques has a parameter \"rays\": choose ray-traced, ray-denoised, or another axis");
    options.axis = "near-plane"; // of the scene: for every technique
    EXPECT_EQ(test::messageOf([&] { sweep(options); }).find("none of"), std::string::npos);
}

TEST(Sweep, TheBreakPointIsTheFirstValueInOrderBeyondTheTolerance) {
    EXPECT_EQ(breakPoint(curve({{1, 0.001}, {0.5, 0.005}, {0.2, 0.006}, {0.1, 0.001}})), 0.2); // 0.005 is still tolerated
    EXPECT_EQ(breakPoint(curve({{1, 0.001}, {0.5, 0.002}})), std::nullopt);
    std::vector<Record> gap = curve({{1, 0.1}, {0.5, 0.1}});
    gap[0].status = Status::NotApplicable;
    EXPECT_EQ(breakPoint(gap), 0.5);
}

TEST(Sweep, RecordsKeepTheirStep) {
    Record record = curve({{0.25, 0.001}}).front();
    record.sweep->breakPoint = 0.125;
    const Record read = parseRecord(toJson(record));
    ASSERT_TRUE(read.sweep);
    EXPECT_EQ(read.sweep->axis, "near-plane");
    EXPECT_EQ(read.sweep->unit, "m");
    EXPECT_EQ(read.sweep->curve, "sm-psm");
    EXPECT_EQ(read.sweep->value, 0.25);
    EXPECT_EQ(read.sweep->breakPoint, 0.125);
}

TEST(Sweep, ATableWritesLargeValuesInFull) {
    EXPECT_NE(report::sweepTable(curve({{1048576, 0.001}})).find("| 1048576 |"), std::string::npos);
}

TEST(Sweep, ATableHasARowATechniqueAndAColumnAValue) {
    std::vector<Record> records = curve({{1, 0.001}, {0.5, 0.02}});
    for (Record& record : records) record.sweep->breakPoint = 0.5;
    std::vector<Record> other = curve({{1, 0.0}, {0.5, 0.0}});
    for (Record& record : other) record.sweep->curve = "sm-lispsm";
    other[1].status = Status::Error;
    records.insert(records.end(), other.begin(), other.end());
    EXPECT_EQ(report::sweepTable(records), "dueling-frusta: mismatching pixels, tolerance 0.5 %\n\n"
                                           "| near-plane [m] | 1 | 0.5 | breaks at |\n|---|--:|--:|--:|\n"
                                           "| sm-psm | 0.10 % | 2.00 % | 0.5 |\n"
                                           "| sm-lispsm | 0.00 % | error | – |\n");
}

} // namespace
} // namespace shadowbench
