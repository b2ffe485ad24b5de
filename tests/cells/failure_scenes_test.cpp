// Every scene's expectations in the gate profile: techniques that it breaks must break, and the others hold.
#include "harness/cells/neighbours.h"
#include "scene/load/load.h"
#include "techniques/gl/api.h"
#include "tests/support/cell_stage.h"
#include "tests/support/expected_techniques.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

namespace shadowbench {
namespace {

std::vector<std::string> scenesWithExpectations() {
    std::vector<std::string> ids;
    for (const std::string& id : builtinScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        if (!scene.expectations.empty()) ids.push_back(id);
    }
    return ids;
}

bool needsMovingFrames(const Scene& scene) {
    const auto aboutMotion = [](const Expectation& e) {
        const std::string& metric = e.bound.metric;
        return metric == "flicker" || metric == "flip_rate" || metric == "moving_rmse" || metric == "disocclusion_error";
    };
    return std::ranges::any_of(scene.expectations, aboutMotion);
}

class FailureScene : public testing::TestWithParam<std::string> {
protected:
    /// With moving frames only where an expectation is about them.
    static Scene scene() {
        testContext();
        Scene scene = loadScene(GetParam(), Profile::Gate);
        if (!needsMovingFrames(scene)) scene.timeline.moving = 0;
        return scene;
    }

    /// The metric that an expectation is about; nothing, with a note, for a technique that is still to come.
    std::optional<double> measured(const Expectation& expectation) {
        const std::string id = idOf(expectation.technique);
        if (isToCome(id)) {
            std::cout << fmt::format("[     NOTE ] {}: {} is still to come, its expectation is not checked\n",
                                     cells_.scene().id, expectation.technique);
            return std::nullopt;
        }
        if (!inCatalogue(id)) {
            ADD_FAILURE() << "there is no technique " << id << ", of which " << cells_.scene().id << " expects something";
            return std::nullopt;
        }
        Record record = cells_.scored(expectation.technique);
        const techniques::Variant variant = techniques::parseVariant(expectation.technique);
        if (expectation.bound.metric == "map_step") scoreNeighbourMap(cells_.frames(), variant, 1, record);
        if (expectation.bound.metric == "image_step") {
            const groundtruth::Cache cache = testCache();
            ChangedScene larger(withNeighbourImage(cells_.scene()), cache);
            scoreNeighbourImage(larger.frames(), variant, 1, record);
        }
        const std::optional<double> value = metrics::bounded(record.values, expectation.bound.metric);
        EXPECT_TRUE(value.has_value()) << expectation.technique << " has no " << expectation.bound.metric
                                       << " on this scene";
        return value;
    }

    CellScene cells_{scene()};
};

TEST_P(FailureScene, BreaksAndSparesTheTechniquesThatItLists) {
    for (const Expectation& expected : cells_.scene().expectations) {
        const auto value = measured(expected);
        if (!value) continue;
        EXPECT_TRUE(expected.bound.isKeptBy(*value))
            << expected.technique << (expected.bound.below ? " does not hold (" : " has stopped failing (")
            << expected.bound.metric << " is " << *value << "), though " << expected.reason;
    }
}

INSTANTIATE_TEST_SUITE_P(Gate, FailureScene, testing::ValuesIn(scenesWithExpectations()), nameOfText);

/// A row that keeps the image of its first frame.
class Frozen final : public techniques::Technique {
public:
    explicit Frozen(std::unique_ptr<techniques::Technique> row) : row_(std::move(row)) {}

    void render(const techniques::Frame& frame, const gl::Texture& visibility) override {
        if (kept_) return copy(*kept_, visibility);
        row_->render(frame, visibility);
        copy(visibility, kept_.emplace(gl::Format::R32F, frame.size));
    }

private:
    static void copy(const gl::Texture& from, const gl::Texture& to) {
        const glm::ivec2 size = from.size();
        glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0, size.x, size.y, 1);
    }

    std::unique_ptr<techniques::Technique> row_;
    std::optional<gl::Texture> kept_;
};

double movingErrorOfFrozen(CellScene& cells, const std::string& name) {
    techniques::Variant variant = techniques::parseVariant(name);
    techniques::Entry entry = *variant.entry;
    entry.make = [&](const techniques::Parameters& p) { return std::make_unique<Frozen>(variant.entry->make(p)); };
    const techniques::Variant frozen{&entry, variant.parameters, "frozen:" + variant.name};
    Record record;
    CellImages images;
    scoreCell(cells.frames(), frozen, 1, record, images, CellWork::LeftOut);
    return metrics::bounded(record.values, "moving_rmse").value();
}

TEST(SkinnedCrowd, NoFrozenRowHolds) {
    testContext();
    CellScene cells(loadScene("skinned-crowd", Profile::Gate));
    for (const Expectation& expected : cells.scene().expectations) {
        if (!expected.bound.below) continue;
        ASSERT_EQ(expected.bound.metric, "moving_rmse");
        EXPECT_GT(movingErrorOfFrozen(cells, expected.technique), expected.bound.value) << expected.technique;
    }
}

TEST(TechniquesToCome, AreNotBuiltYet) {
    for (const std::string_view id : techniquesToCome)
        EXPECT_FALSE(inCatalogue(id)) << id << " is built: take it off the list";
}

} // namespace
} // namespace shadowbench
