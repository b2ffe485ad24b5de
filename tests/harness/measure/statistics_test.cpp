#include "base/error.h"
#include "harness/measure/statistics.h"

#include <gtest/gtest.h>

namespace shadowbench::timing {
namespace {

TEST(Statistics, MedianOfOddAndEvenCounts) {
    EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2);
    EXPECT_DOUBLE_EQ(median({4, 1, 3, 2}), 2.5);
    EXPECT_DOUBLE_EQ(median({7}), 7);
}

TEST(Statistics, PercentileIsLinearBetweenOrderStatistics) {
    EXPECT_DOUBLE_EQ(percentile({0, 10, 20, 30, 40}, 0.95), 38);
    EXPECT_DOUBLE_EQ(percentile({5, 1}, 0), 1);
    EXPECT_DOUBLE_EQ(percentile({5, 1}, 1), 5);
}

TEST(Statistics, MedianDeviationIgnoresOneOutlier) { EXPECT_DOUBLE_EQ(medianDeviation({1, 1, 2, 2, 1000}), 1); }

TEST(Statistics, NothingHasNoMedian) { EXPECT_THROW(median({}), InternalError); }

} // namespace
} // namespace shadowbench::timing
