// Refinement of the quadtree over a light's plane against closed forms.
#include "techniques/maps/sm-adaptive/refinement.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench::techniques {
namespace {

/// A demand in the middle of each cell of a grid of `side` × `side`.
std::vector<Demand> evenDemands(int side, float pixels) {
    std::vector<Demand> demands;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            demands.push_back({0, (glm::vec2(x, y) + 0.5F) / static_cast<float>(side), glm::vec2(pixels)});
    return demands;
}

/// Demands of very different size, denser towards a corner, on two planes.
std::vector<Demand> unevenDemands(std::size_t count) {
    std::vector<Demand> demands;
    std::mt19937 random(7);
    const auto next = [&] { return static_cast<float>(random() >> 8) / 16777216.0F; };
    for (std::size_t i = 0; i < count; ++i) {
        const float x = next(), y = next(), size = next();
        demands.push_back({static_cast<int>(i % 2), {x * x, y * y * y}, glm::vec2(50.0F / (x * x + 0.01F), 4000 * size)});
    }
    return demands;
}

bool holds(const Page& page, const Demand& demand) {
    return page.plane == demand.plane && cellOf(demand.at, 1 << page.level) == page.at;
}

TEST(Refinement, GivesAPixelTheFirstLevelWhoseTexelsAreNoLongerThanIt) {
    for (const float pixels : {10.0F, 128.0F, 129.0F, 1000.0F, 1024.0F, 5000.0F}) {
        const int level = std::max(0, static_cast<int>(std::ceil(std::log2(pixels / 128))));
        const glm::vec2 at(0.7F, 0.2F);
        const Page expected{0, level, glm::ivec2(at * static_cast<float>(1 << level))};
        EXPECT_EQ(refine({{0, at, {pixels, 1}}}, {}), std::vector{expected}) << pixels;
        EXPECT_EQ(refine({{0, at, {1, pixels}}}, {}), std::vector{expected}) << pixels;
    }
}

TEST(Refinement, DensityAsksForSoManyTexelsAlongAPixel) {
    const auto level = [](double density) {
        return refine({{0, {0.1F, 0.1F}, {1000, 1000}}}, {.density = density}).at(0).level;
    };
    EXPECT_EQ(level(1), 3); // 128 · 8 ≥ 1000
    EXPECT_EQ(level(4), 5);
    EXPECT_EQ(level(0.5), 2);
}

TEST(Refinement, LeavesAPageThatSufficesForItsShareOfPixels) {
    // 100 pixels in one page of level 8, of which so many need level 3; for the others a map of the plane is enough.
    const auto level = [](int demanding, double share) {
        std::vector<Demand> demands;
        for (int i = 0; i < 100; ++i) demands.push_back({0, {0.3F, 0.6F}, glm::vec2(i < demanding ? 1000.0F : 50.0F)});
        return refine(demands, {.share = share}).at(0).level;
    };
    EXPECT_EQ(level(1, 1), 3);
    EXPECT_EQ(level(5, 0.95), 0);
    EXPECT_EQ(level(6, 0.95), 3);
    EXPECT_EQ(level(100, 0.5), 3);
    EXPECT_EQ(level(100, 0), 0);
}

TEST(Refinement, EndsAtTheFinestLevel) {
    EXPECT_EQ(refine({{0, {0.9F, 0.9F}, {1e9F, 1}}}, {.levels = 5}), (std::vector{Page{0, 5, {28, 28}}}));
}

TEST(Refinement, CoversEvenDemandsWithEqualPages) {
    const std::vector<Page> pages = refine(evenDemands(32, 500), {});
    ASSERT_EQ(pages.size(), 16U); // level 2: 512 ≥ 500
    for (const Page& page : pages) EXPECT_EQ(page.level, 2);
}

TEST(Refinement, LeavesOutWhatNoPixelAsksFor) {
    std::vector<Demand> quarter = evenDemands(32, 500);
    std::erase_if(quarter, [](const Demand& d) { return d.at.x > 0.5F || d.at.y > 0.5F; });
    EXPECT_EQ(refine(quarter, {}).size(), 4U);
    EXPECT_TRUE(refine({}, {}).empty());
}

TEST(Refinement, HoldsEveryDemandInOnePageWithinAnyBudget) {
    const std::vector<Demand> demands = unevenDemands(3000);
    for (const int budget : {6, 7, 20, 100, 1000}) {
        const std::vector<Page> pages = refine(demands, {.pages = budget});
        EXPECT_LE(pages.size(), static_cast<std::size_t>(budget));
        EXPECT_GE(pages.size(), std::min<std::size_t>(static_cast<std::size_t>(budget) - 2, 400)); // a cut adds up to 3
        for (const Demand& demand : demands)
            ASSERT_EQ(std::count_if(pages.begin(), pages.end(), [&](const Page& page) { return holds(page, demand); }), 1);
    }
}

TEST(Refinement, SpendsItsBudgetWhereTexelsAreTooLongByTheMost) {
    std::vector<Demand> demands;
    for (int i = 0; i < 10; ++i) {
        demands.push_back({0, {0.01F, 0.01F + 0.005F * static_cast<float>(i)}, {300, 300}});
        demands.push_back({1, {0.01F, 0.01F + 0.005F * static_cast<float>(i)}, {3000, 3000}});
        demands.push_back({0, {0.9F, 0.9F}, {300, 300}}); // so that a cut of plane 0 takes a page
    }
    // Plane 1 needs level 5, where its demands take two pages: it stays at 4, where they are in one.
    for (const Page& page : refine(demands, {.pages = 2})) EXPECT_EQ(page.level, page.plane == 0 ? 0 : 4) << page.plane;
}

TEST(Refinement, DoesNotDependOnTheOrderOfPixels) {
    std::vector<Demand> demands = unevenDemands(1000);
    const std::vector<Page> pages = refine(demands, {.pages = 50});
    std::reverse(demands.begin(), demands.end());
    EXPECT_EQ(refine(demands, {.pages = 50}), pages);
}

} // namespace
} // namespace shadowbench::techniques
