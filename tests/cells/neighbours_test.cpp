// The same row with a map, and with an image, that is a fortieth larger.
#include "harness/cells/neighbours.h"
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Neighbours, AreAFortiethLarger) {
    EXPECT_EQ(neighbourOf(1024), 1050);
    EXPECT_EQ(neighbourOf(256), 262);
    EXPECT_EQ(neighbourOf(40), 41);
}

TEST(Neighbours, OfAVariantHaveALargerMapAndNothingElse) {
    const auto neighbour = withNeighbourMap(techniques::parseVariant("pcss:taps=25+49,map=512"));
    ASSERT_TRUE(neighbour.has_value());
    EXPECT_EQ(neighbour->name, "pcss:taps=25+49,map=525");
    EXPECT_FALSE(withNeighbourMap(techniques::parseVariant("volume-zfail")).has_value());
}

TEST(StepBetweenErrors, IsTheirRatioEitherWay) {
    EXPECT_DOUBLE_EQ(stepBetween(Truth::Soft, 0.02, 0.06), 3);
    EXPECT_DOUBLE_EQ(stepBetween(Truth::Soft, 0.06, 0.02), 3);
    EXPECT_DOUBLE_EQ(stepBetween(Truth::Hard, 0, 0.0005), 1); // half a pixel in a thousand says nothing
    EXPECT_DOUBLE_EQ(stepBetween(Truth::Hard, 0, 0.003), 3);
}

TEST(SanityOfACell, IsAMultipleOfTheErrorOfAnImageWithoutShadows) {
    CellScene& cells = stillScene("contact", 1);
    EXPECT_EQ(cells.scored("none").values["sanity.times_none"], 1.0);
    const Record& record = cells.scored("sm-uniform");
    EXPECT_DOUBLE_EQ(record.values["sanity.times_none"].value(),
                     record.values["accuracy.mismatch"].value() / cells.scored("none").values["accuracy.mismatch"].value());
}

TEST(SanityOfACell, StepsLittleWhereAMethodIsSound) {
    CellScene& cells = stillScene("contact", 1);
    const groundtruth::Cache cache = testCache();
    ChangedScene larger(withNeighbourImage(cells.scene()), cache);
    Record record = cells.scored("sm-uniform");
    scoreNeighbourMap(cells.frames(), techniques::parseVariant("sm-uniform"), 1, record);
    scoreNeighbourImage(larger.frames(), techniques::parseVariant("sm-uniform"), 1, record);
    EXPECT_LT(record.values["sanity.map_step"].value(), 2);
    EXPECT_LT(record.values["sanity.image_step"].value(), 2);
    record = cells.scored("none");
    scoreNeighbourMap(cells.frames(), techniques::parseVariant("none"), 1, record);
    scoreNeighbourImage(larger.frames(), techniques::parseVariant("none"), 1, record);
    EXPECT_FALSE(record.values["sanity.map_step"].has_value());
    EXPECT_LT(record.values["sanity.image_step"].value(), 1.1); // the shadow's share of the receivers is the scene's
}

} // namespace
} // namespace shadowbench
