// Techniques without texels are exact: where their label differs from the truth, the truth itself changes within a fiftieth
// of a pixel, or, where the near plane is so close that the depth buffer is coarser, within a step of it; or the depth
// buffer shows another surface there, which lies less than a step behind the true one.
#include "scene/load/load.h"
#include "tests/support/cell_stage.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <iostream>

namespace shadowbench {
namespace {

constexpr double nearEdge = 0.02; // pixels

/// The truth on a grid of points of the image that all lie within `radius` pixels of a pixel's centre, which is its middle.
groundtruth::Reference magnified(const Snapshot& snapshot, glm::ivec2 size, glm::ivec2 pixel, double radius) {
    constexpr int side = 17;
    groundtruth::Request request{snapshot, {side, side}, groundtruth::Truth::Hard};
    request.oracle = groundtruth::Oracle::Rays;
    Camera& camera = request.snapshot.camera;
    const glm::dvec3 ray = camera.ray(glm::dvec2(pixel) + 0.5, size);
    const double length = glm::length(ray);
    camera.target = camera.eye + ray;
    camera.near *= length;
    camera.far *= length;
    // A shift by one pixel in the image is one of at least `pitch` in the image plane of a camera that looks at the pixel.
    const double pitch = 2 * std::tan(glm::radians(camera.fovy) / 2) / size.y / (length * length);
    const double corner = radius * pitch / std::sqrt(2.0); // of the grid, along a side
    camera.fovy = glm::degrees(2 * std::atan(corner * side / (side - 1)));
    return groundtruth::compute(request);
}

/// Whether the label, the surface or whether it faces the light changes there.
bool truthChanges(const groundtruth::Reference& around) {
    const auto isLikeFirst = [&](std::size_t i) {
        return around.visibility[i] == around.visibility[0] && around.surface[i] == around.surface[0] &&
               around.id[i] == around.id[0];
    };
    for (std::size_t i = 1; i < around.id.size(); ++i)
        if (!isLikeFirst(i)) return true;
    return false;
}

/// What one step of the 32-bit depth buffer is at a depth of `z` metres: metres.
double depthStep(const Camera& camera, double z) { return std::exp2(-24) * z * z * (1 / camera.near - 1 / camera.far); }

/// The same in pixels.
double depthStep(const Camera& camera, glm::ivec2 size, double z) {
    return depthStep(camera, z) / (z * 2 * std::tan(glm::radians(camera.fovy) / 2) / size.y);
}

struct Differing {
    glm::ivec2 pixel;
    double distance; // to the nearest edge that the reference knows, in pixels
    double z;        // depth before the eye, in metres
    double behind;   // how much deeper what is drawn lies than the true surface, in metres
};

struct Comparison {
    std::size_t compared = 0;
    std::vector<Differing> differing;
    double offEdge = 0; // share of all compared
};

Comparison compared(CellScene& cells, const std::string& variant) {
    const Scene& scene = cells.scene();
    Stage& stage = cells.stage();
    const int frame = scene.timeline.still - 1;
    stage.show(frame);
    const auto technique = techniques::parseVariant(variant).entry->make(techniques::parseVariant(variant).parameters);
    stage.render(*technique, frame, 1);
    const Image<float> v = stage.visibility();
    const groundtruth::Reference& truth = cells.truths().at(Truth::Hard, frame);
    const metrics::Drawn drawn = stage.drawn();
    const metrics::Mask mask = metrics::receiverMask(truth, drawn, stage.shown().camera.eye);
    const auto depthOf = [&](const glm::vec3& p) { return stage.shown().camera.project(glm::dvec3(p), scene.size).z; };
    Comparison result;
    result.compared = mask.count;
    result.offEdge = *metrics::labelErrors({v, truth, mask}).mismatchOffEdge;
    for (int y = 0; y < v.height(); ++y)
        for (int x = 0; x < v.width(); ++x)
            if (mask.scored(x, y) != 0 && (v(x, y) >= 0.5F) != (truth.visibility(x, y) >= 0.5F))
                result.differing.push_back({{x, y},
                                            truth.edgeDistance(x, y),
                                            depthOf(truth.position(x, y)),
                                            depthOf(drawn.position(x, y)) - depthOf(truth.position(x, y))});
    return result;
}

bool isClosed(const Scene& scene) {
    return std::ranges::all_of(scene.objects, [](const Object& object) {
        return std::ranges::all_of(object.levels, [](const Level& level) { return level.mesh->closed; });
    });
}

struct Case {
    std::string scene, variant;
};

/// How a failing case is printed.
void PrintTo(const Case& cell, std::ostream* out) { *out << cell.variant << " on " << cell.scene; }

std::vector<Case> everyExactCell() {
    std::vector<Case> cases;
    for (const std::string& id : builtinScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        if (scene.light.isEnvironment()) continue;                                            // no hard shadows there
        const bool fails = std::ranges::any_of(scene.expectations, [](const Expectation& e) { // as the scene says
            return e.technique == "sm-alias-free" && !e.bound.below;
        });
        if (!fails) cases.push_back({id, "sm-alias-free"});
        cases.push_back({id, "frustum-traced"});
        if (isClosed(scene)) cases.insert(cases.end(), {{id, "volume-zfail"}, {id, "sm-zpp"}});
    }
    return cases;
}

class ExactTechnique : public testing::TestWithParam<Case> {};

TEST_P(ExactTechnique, DiffersFromTheTruthOnlyWhereTheTruthChanges) {
    CellScene& cells = stillScene(GetParam().scene);
    const Scene& scene = cells.scene();
    const Comparison found = compared(cells, GetParam().variant);
    EXPECT_LE(found.offEdge, 0.0002);

    const Snapshot shown = snapshot(scene, scene.timeline.still - 1);
    std::size_t farther = 0;
    for (const auto& [pixel, distance, z, behind] : found.differing) {
        const auto changesWithin = [&, p = pixel, d = distance](double radius) {
            return d <= radius || truthChanges(magnified(shown, scene.size, p, radius));
        };
        if (changesWithin(nearEdge)) continue;
        ++farther;
        const bool anotherSurface =
            behind > 1e-6 * z && behind <= depthStep(shown.camera, z); // positions are rounded to less
        const bool counted = GetParam().variant == "volume-zfail" || GetParam().variant == "sm-zpp"; // against depths
        const double step = counted ? depthStep(shown.camera, scene.size, z) : 0;
        EXPECT_TRUE(anotherSurface || changesWithin(nearEdge + step))
            << "(" << pixel.x << ", " << pixel.y << ") lies " << distance << " px from the nearest edge";
    }
    std::cout << fmt::format("{} on {}: {} of {} pixels differ, {} of them farther than {} px from an edge\n",
                             GetParam().variant, scene.id, found.differing.size(), found.compared, farther, nearEdge);
}

std::string caseName(const testing::TestParamInfo<Case>& tested) {
    return testName(tested.param.scene + "_" + tested.param.variant);
}

INSTANTIATE_TEST_SUITE_P(Gate, ExactTechnique, testing::ValuesIn(everyExactCell()), caseName);

} // namespace
} // namespace shadowbench
