// What cells say of seeds.
#include "tests/support/cell_stage.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// The values of a variant on a still scene, drawn with four seeds.
Record scoredBySeeds(const std::string& variant) {
    CellScene& cells = stillScene("contact", 1);
    Record record;
    CellImages images;
    const techniques::Variant chosen = techniques::parseVariant(variant);
    scoreCell(cells.frames(), chosen, 1, record, images);
    splitErrorOverSeeds(cells.frames(), chosen, 1, 4, images.visibility(), record);
    return record;
}

TEST(SeedsOfACell, SplitTheErrorOfWhatDependsOnThem) {
    const Record record = scoredBySeeds("pcf-poisson");
    const auto value = [&](metrics::MetricId metric) { return record.values[metric].value(); };
    EXPECT_GT(value("stability.seeds.noise"), 0);
    EXPECT_NEAR(value("stability.seeds.rmse"), value("accuracy.rmse"), 0.1 * value("accuracy.rmse"));
    EXPECT_NEAR(value("stability.seeds.rmse"),
                std::hypot(value("stability.seeds.systematic"), value("stability.seeds.noise")), 1e-6);
}

TEST(SeedsOfACell, SayNothingOfWhatDoesNotDependOnThem) {
    EXPECT_FALSE(scoredBySeeds("pcf").values["stability.seeds.noise"]);
}

TEST(SeedsOfACell, ArePartOfItsId) {
    CellScene& cells = stillScene("contact", 1);
    const techniques::Variant variant = techniques::parseVariant("pcf-poisson");
    MeasureOptions options;
    const std::string one = cellId(cells.truths(), cells.scene(), variant, options);
    options.seeds = 4;
    EXPECT_NE(cellId(cells.truths(), cells.scene(), variant, options), one);
    options.seeds = 1;
    options.views = 5;
    EXPECT_NE(cellId(cells.truths(), cells.scene(), variant, options), one);
}

} // namespace
} // namespace shadowbench
