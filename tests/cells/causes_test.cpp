// What rows are wrong by, where it is known because it was planted.
#include "harness/cells/changed_scene.h"
#include "harness/studies/causes/causes.h"
#include "harness/studies/sweep/axis.h"
#include "techniques/shared/maps/single_map.h"
#include "tests/support/cell_stage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <optional>

namespace shadowbench::causes {
namespace {

using techniques::Entry;
using techniques::Variant;

constexpr glm::ivec2 small(128);

Scene smallScene(const std::string& id) {
    Scene scene = loadScene(id, Profile::Gate);
    scene.size = small;
    scene.timeline = {2, 0, 0};
    return scene;
}

/// The first still frame after the camera has turned: a history holds what it saw on the way.
Scene turnedScene(const std::string& id) {
    Scene scene = smallScene(id);
    scene.timeline.still = 1;
    axisNamed("turn").move(scene, 30);
    return scene;
}

/// A uniform map of the middle of the scene alone.
const Entry& middleMap() {
    static const Entry entry = [] {
        Entry result = techniques::entryNamed("sm-uniform");
        result.make = [](const techniques::Parameters& parameters) {
            return techniques::makeSingleMap(parameters, [](const techniques::Frame& frame) {
                techniques::LightView view = techniques::uniformView(frame);
                view.clipFromWorld = glm::scale(glm::dmat4(1), glm::dvec3(2, 2, 1)) * view.clipFromWorld;
                return view;
            });
        };
        return result;
    }();
    return entry;
}

/// A scene on the stage, as long as its explanations.
struct Staged {
    explicit Staged(Scene scene) : changed(std::move(scene), cache()) {}
    static const groundtruth::Cache& cache() {
        static const groundtruth::Cache shared = testCache();
        return shared;
    }
    ChangedScene changed;

    Explanation explained(const Variant& row, int casterLevel = 0) {
        SceneFrames& frames = changed.frames();
        std::vector<Batch> casters;
        if (casterLevel > 0) casters = castersAtLevel(frames.scene(), frames.scored(), casterLevel);
        return explain(frames, row, 1, casterLevel > 0 ? &casters : nullptr);
    }
    Explanation explained(const std::string& row) { return explained(techniques::parseVariant(row)); }
};

struct Plant {
    Cause cause;
    std::string scene, row;
    int casterLevel = 0;
};

/// Three scenes a cause, each with what the cause needs: thin casters for filters and coarse maps, casters that touch the
/// ground for biases, casters above each other for combinations, levels for geometry.
const std::vector<Plant> plants{
    {Cause::Outside, "caster-behind-eye", "sm-psm:behind=lost"},
    {Cause::Outside, "contact", "middle"},
    {Cause::Outside, "windmills", "middle"},
    {Cause::Undersampled, "contact", "sm-uniform:map=64"},
    {Cause::Undersampled, "windmills", "sm-uniform:map=64"},
    {Cause::Undersampled, "picket-fence", "sm-uniform:map=64"},
    {Cause::SmallBias, "contact", "sm-uniform:bias=none"},
    {Cause::SmallBias, "windmills", "sm-uniform:factor=0,units=0"},
    {Cause::SmallBias, "caster-behind-eye", "sm-uniform:bias=constant,units=0"},
    {Cause::LargeBias, "contact", "sm-uniform:factor=64"},
    {Cause::LargeBias, "contact", "sm-uniform:bias=constant,units=1600000"},
    {Cause::LargeBias, "dueling-frusta", "sm-uniform:factor=64"},
    {Cause::Filter, "windmills", "pcf-poisson:radius=32"},
    {Cause::Filter, "trees", "pcf-poisson:radius=32"},
    {Cause::Filter, "picket-fence", "vsm:kernel=64"},
    {Cause::History, "contact", "sm-history"},
    {Cause::History, "windmills", "sm-history"},
    {Cause::History, "moving-caster", "temporal-soft"},
    {Cause::Fusion, "overlapping-occluders", "backprojection"},
    {Cause::Fusion, "stacked-plates", "backprojection"},
    {Cause::Fusion, "depth-complexity", "backprojection"},
    {Cause::Leak, "overlapping-occluders", "vsm"},
    {Cause::Leak, "stacked-plates", "vsm:kernel=15"},
    {Cause::Leak, "trees", "vsm"},
    {Cause::Geometry, "windmills", "sm-uniform", 3},
    {Cause::Geometry, "trees", "sm-uniform", 3},
    {Cause::Geometry, "simple", "sm-alias-free", 3},
};

Variant rowOf(const Plant& plant) {
    if (plant.row == "middle") return {&middleMap(), techniques::parseVariant("sm-uniform").parameters, "middle"};
    return techniques::parseVariant(plant.row);
}

double sum(const Explanation& explanation) {
    return std::accumulate(explanation.parts.begin(), explanation.parts.end(), 0.0,
                           [](double all, const auto& part) { return all + part.second; });
}

TEST(Causes, WhatWasPlantedIsNamedFirst) {
    testContext();
    std::vector<std::string> misses;
    for (const Plant& plant : plants) {
        Staged staged(plant.cause == Cause::History ? turnedScene(plant.scene) : smallScene(plant.scene));
        const Explanation explanation = staged.explained(rowOf(plant), plant.casterLevel);
        const std::string line = fmt::format("{} on {}, {:.4f}: {}; {}", plant.row, plant.scene, explanation.error,
                                             sharesText(explanation), explanation.change);
        RecordProperty(plant.row + plant.scene, line);
        EXPECT_GT(explanation.error, 0.002) << line;
        EXPECT_NEAR(sum(explanation), explanation.error, 1e-6) << line;
        if (explanation.parts.front().first != plant.cause) misses.push_back(line);
    }
    EXPECT_LE(misses.size(), plants.size() / 12) << fmt::format("{}", fmt::join(misses, "\n"));
}

} // namespace
} // namespace shadowbench::causes
