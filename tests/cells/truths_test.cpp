// What records say of the truths that their cells were scored against.
#include "tests/support/cell_stage.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(TruthsOfRecords, NameTheContentOfEveryTruth) {
    CellScene& cells = stillScene("simple");
    const int frame = cells.scene().timeline.still - 1;
    const Record& hard = cells.scored("none");
    ASSERT_TRUE(hard.reference && hard.softReference);
    EXPECT_EQ(hard.reference->content, cells.truths().content(Truth::Hard, frame));
    EXPECT_EQ(hard.softReference->content, cells.truths().content(Truth::Soft, frame));
    EXPECT_NE(hard.reference->content, hard.softReference->content);
    EXPECT_FALSE(hard.reference->area) << "an exact truth needs none beside it";
}

TEST(TruthsOfRecords, HoldBothErrorsUnderAnAreaLight) {
    CellScene& cells = stillScene("simple");
    const Record& soft = cells.scored("pcss");
    ASSERT_TRUE(soft.reference && soft.reference->area);
    const AreaInfo& area = *soft.reference->area;
    EXPECT_EQ(area.key, cells.truths().key(Truth::Area, cells.scene().timeline.still - 1));
    EXPECT_GT(area.rms, 0.0005); // 1,024 samples leave some two thousandths
    EXPECT_LT(area.rms, 0.003);
    const double sampled = soft.values["accuracy.rmse"].value();
    EXPECT_NE(area.rmse, sampled);
    EXPECT_NEAR(area.rmse, sampled, area.rms); // the triangle inequality
}

} // namespace
} // namespace shadowbench
