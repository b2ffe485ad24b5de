// Which pages of an adaptive shadow map are kept, and what of the casters has changed.
#include "techniques/shared/maps/caster_changes.h"
#include "techniques/shared/maps/page_cache.h"

#include "scene/meshes/primitives.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::techniques {
namespace {

/// Pages first … first + count − 1 of a row.
std::vector<Page> row(int first, int count) {
    std::vector<Page> pages;
    for (int i = 0; i < count; ++i) pages.push_back({0, 8, {first + i, 0}});
    return pages;
}

std::size_t drawn(const std::vector<Filling>& fillings) {
    std::size_t count = 0;
    for (const Filling& filling : fillings)
        count += static_cast<std::size_t>(std::ranges::count(filling, false, &HeldPage::kept));
    return count;
}

/// Every page once, and no slot twice in a filling.
void expectPlaced(const std::vector<Filling>& fillings, std::size_t pages, int slots) {
    std::set<std::size_t> numbers;
    for (const Filling& filling : fillings) {
        std::set<int> used;
        for (const HeldPage& held : filling) {
            EXPECT_TRUE(numbers.insert(held.number).second);
            EXPECT_TRUE(used.insert(held.slot).second);
            EXPECT_GE(held.slot, 0);
            EXPECT_LT(held.slot, slots);
        }
    }
    EXPECT_EQ(numbers.size(), pages);
}

TEST(PageCache, DrawsAPageOnceAsLongAsItIsKept) {
    PageCache cache(16);
    EXPECT_EQ(drawn(cache.place(row(0, 10))), 10U);
    const auto again = cache.place(row(0, 10));
    expectPlaced(again, 10, 16);
    EXPECT_EQ(again.size(), 1U);
    EXPECT_EQ(drawn(again), 0U);
    EXPECT_EQ(drawn(cache.place(row(4, 10))), 4U);
    cache.clear();
    EXPECT_EQ(drawn(cache.place(row(4, 10))), 10U);
}

TEST(PageCache, OverwritesWhatHasNotBeenAskedForTheLongest) {
    PageCache cache(8);
    cache.place(row(0, 4));
    cache.place(row(4, 4));
    cache.place(row(0, 4));
    EXPECT_EQ(drawn(cache.place(row(8, 4))), 4U); // over 4 … 7
    EXPECT_EQ(drawn(cache.place(row(0, 4))), 0U);
    EXPECT_EQ(drawn(cache.place(row(4, 4))), 4U);
}

TEST(PageCache, FillsItsSlotsAgainWhereAFramesPagesDoNotFit) {
    PageCache cache(8);
    for (const int count : {8, 9, 16, 17, 40}) {
        cache.clear();
        const auto first = cache.place(row(0, count));
        expectPlaced(first, static_cast<std::size_t>(count), 8);
        EXPECT_EQ(first.size(), static_cast<std::size_t>((count + 7) / 8)) << count;
        EXPECT_EQ(drawn(first), static_cast<std::size_t>(count));
        const auto second = cache.place(row(0, count));
        expectPlaced(second, static_cast<std::size_t>(count), 8);
        EXPECT_EQ(drawn(second), static_cast<std::size_t>(count - 8)) << count; // as many as there are slots were kept
    }
    EXPECT_TRUE(cache.place({}).empty());
}

TEST(PageCache, ForgetsStalePages) {
    PageCache cache(16);
    cache.place(row(0, 10));
    cache.drop([](const Page& page) { return page.at.x % 2 == 0; });
    const auto fillings = cache.place(row(0, 10));
    for (const HeldPage& held : fillings.at(0)) EXPECT_EQ(held.kept, held.number % 2 == 1);
}

Snapshot twoCubes(const std::shared_ptr<const Mesh>& mesh, double x) {
    Snapshot snapshot;
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0));
    snapshot.batches.push_back({mesh, {}, false, {{glm::dmat4(1), glm::dmat4(1), 1}, {moved, moved, 2}}});
    return snapshot;
}

TEST(CasterChanges, AreTheBoxesOfWhatHasMoved) {
    const auto mesh = std::make_shared<const Mesh>(box({1, 1, 1}));
    CasterChanges changes;
    EXPECT_FALSE(changes.since(twoCubes(mesh, 3)));
    EXPECT_EQ(changes.since(twoCubes(mesh, 3))->size(), 0U);
    const auto moved = changes.since(twoCubes(mesh, 5));
    ASSERT_TRUE(moved && moved->size() == 16);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR((*moved)[i].x, i < 8 ? 3 : 5, 0.5);
    EXPECT_EQ(changes.since(twoCubes(mesh, 5))->size(), 0U);
}

TEST(CasterChanges, AreTheBoxesBeforeAndAfterOfWhatDeforms) {
    const auto mesh = std::make_shared<const Mesh>(box({1, 1, 1})), wider = std::make_shared<const Mesh>(box({2, 1, 1}));
    CasterChanges changes;
    changes.since(twoCubes(mesh, 3));
    Snapshot deformed = twoCubes(mesh, 3); // the second in a batch of its own, before that of the first
    deformed.batches.push_back(deformed.batches[0]);
    deformed.batches[0].mesh = wider;
    std::erase_if(deformed.batches[0].placements, [](const Placement& placement) { return placement.id == 1; });
    std::erase_if(deformed.batches[1].placements, [](const Placement& placement) { return placement.id == 2; });
    const auto changed = changes.since(deformed);
    ASSERT_TRUE(changed && changed->size() == 16);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(std::abs((*changed)[i].x - 3), i < 8 ? 0.5 : 1);
}

TEST(CasterChanges, SayNothingWhereCastersCameOrGo) {
    const auto mesh = std::make_shared<const Mesh>(box({1, 1, 1}));
    CasterChanges changes;
    changes.since(twoCubes(mesh, 3));
    Snapshot three = twoCubes(mesh, 3);
    three.batches.push_back({mesh, {}, false, {{glm::dmat4(1), glm::dmat4(1), 3}}});
    EXPECT_FALSE(changes.since(three));
    EXPECT_TRUE(changes.since(three));
    changes.forget();
    EXPECT_FALSE(changes.since(three));
}

} // namespace
} // namespace shadowbench::techniques
