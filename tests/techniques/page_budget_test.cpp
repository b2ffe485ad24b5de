// Which pages of a clipmap find room in a pool.
#include "techniques/modern/sm-clipmap/page_budget.h"

#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

constexpr int coarsest = 3;

std::vector<Page> fit(const AskedPages& asked, std::size_t room) { return pagesThatFit(asked, coarsest, room); }

TEST(PageBudget, KeepsAllThatFit) {
    const AskedPages asked{{{0, 0, {3, 2}}, 5}, {{0, 1, {1, 1}}, 1}};
    const std::vector<Page> all{{0, 0, {3, 2}}, {0, 1, {1, 1}}};
    EXPECT_EQ(fit(asked, 2), all);
    EXPECT_EQ(fit(asked, 100), all);
    EXPECT_TRUE(fit({}, 1).empty());
}

TEST(PageBudget, PixelsOfThePageThatTheFewestAskForGoToTheNextCoarserLevel) {
    const AskedPages asked{{{0, 0, {2, 2}}, 10}, {{0, 0, {3, 3}}, 20}, {{0, 0, {8, 8}}, 40}};
    // The first goes to (1, 1) of level 1, which has its 10 pixels alone and goes on to the coarsest level, where it stays;
    // the second follows and joins it.
    EXPECT_EQ(fit(asked, 2), (std::vector<Page>{{0, 0, {8, 8}}, {0, 3, {0, 0}}}));
}

TEST(PageBudget, PixelsThatHaveGoneToOnePageAddUp) {
    const AskedPages asked{
        {{0, 0, {0, 0}}, 10}, {{0, 0, {1, 0}}, 10}, {{0, 0, {0, 1}}, 10}, {{0, 1, {7, 7}}, 15}, {{0, 2, {9, 9}}, 90}};
    EXPECT_EQ(fit(asked, 3), (std::vector<Page>{{0, 1, {0, 0}}, {0, 1, {7, 7}}, {0, 2, {9, 9}}}));
    EXPECT_EQ(fit(asked, 2), (std::vector<Page>{{0, 3, {0, 0}}, {0, 3, {4, 4}}})); // of 30 and of 90, not that of 15
}

TEST(PageBudget, ColumnsBeforeTheOriginAreRoundedDown) {
    EXPECT_EQ(coarserPage({0, 4, {-1, -4}}), (Page{0, 5, {-1, -2}}));
    EXPECT_EQ(coarserPage({2, -3, {5, 0}}), (Page{2, -2, {2, 0}}));
}

TEST(PageBudget, PagesOfTheCoarsestLevelGoLast) {
    const AskedPages asked{{{0, 2, {4, 4}}, 1000}, {{0, 3, {0, 0}}, 1}, {{0, 3, {1, 0}}, 2}};
    EXPECT_EQ(fit(asked, 2), (std::vector<Page>{{0, 3, {1, 0}}, {0, 3, {2, 2}}}));
    EXPECT_EQ(fit(asked, 1), (std::vector<Page>{{0, 3, {2, 2}}}));
}

} // namespace
} // namespace shadowbench::techniques
