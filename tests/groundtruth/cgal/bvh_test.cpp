// A tree only proposes, so its one promise is that it leaves out nothing that a segment meets.
#include "base/random.h"
#include "groundtruth/cgal/geometry/bvh.h"
#include "groundtruth/cgal/geometry/shaft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace shadowbench::groundtruth::geometry {
namespace {

glm::dvec3 somewhere(Random& random, double reach) {
    glm::dvec3 p(0);
    for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-reach, reach);
    return p;
}

/// The smallest box of floats around a point, made larger by up to `size`, a different share of it to each side.
FloatBox boxAround(const glm::dvec3& point, double size, Random& random) {
    FloatBox box{};
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::nextafter(static_cast<float>(point[axis] - random.uniform(0, size)),
                                       -std::numeric_limits<float>::infinity());
        box.high[axis] = std::nextafter(static_cast<float>(point[axis] + random.uniform(0, size)),
                                        std::numeric_limits<float>::infinity());
    }
    return box;
}

std::set<std::uint32_t> visited(const Bvh& tree, const PaddedSegment& segment) {
    std::set<std::uint32_t> primitives;
    EXPECT_FALSE(tree.visit(segment, [&](std::uint32_t primitive) {
        EXPECT_TRUE(primitives.insert(primitive).second) << "visited twice";
        return false;
    }));
    return primitives;
}

/// Half of `count` boxes touch the segment, in points that rounding keeps at their borders; the others lie anywhere.
void expectNothingLeftOut(PaddedSegment segment, double reach, Random& random, std::uint32_t count) {
    std::vector<FloatBox> boxes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 on = segment.from + random.uniform(0, segment.last) * (segment.to - segment.from);
        const double size = reach * std::pow(10.0, random.uniform(-12, -1));
        boxes.push_back(boxAround(i % 2 == 0 ? on : somewhere(random, reach), size, random));
    }
    const std::set<std::uint32_t> found = visited(Bvh(boxes), segment);
    for (std::uint32_t i = 0; i < count; i += 2) ASSERT_TRUE(found.contains(i)) << "box " << i << " of " << count;
}

TEST(Bvh, LeavesOutNothingThatASegmentMeets) {
    Random random(1);
    for (int round = 0; round < 400; ++round) {
        const double reach = std::pow(10.0, random.uniform(-15, 15));
        PaddedSegment segment{somewhere(random, reach), somewhere(random, reach), glm::dvec3(0), random.uniform(0, 1)};
        for (int axis = 0; axis < 3; ++axis)
            if (random.uniform() < 0.25) segment.to[axis] = segment.from[axis]; // along a plane, an axis or nowhere
        expectNothingLeftOut(segment, reach, random, 1 + static_cast<std::uint32_t>(round));
    }
}

TEST(Bvh, LeavesOutNothingWhereFloatsEnd) {
    Random random(2);
    for (const double reach : {0.0, 1e-40, 1e-25, 1e29, 1e36})
        expectNothingLeftOut({somewhere(random, reach), somewhere(random, reach), glm::dvec3(0)}, reach, random, 40);
    const PaddedSegment far{{0, 0, 0}, {1e200, 0, 0}, glm::dvec3(0)};
    expectNothingLeftOut({far.from, far.to, far.pad, 1e-200}, 1, random, 40);
}

TEST(Bvh, VisitsFewOfTheBoxesThatASegmentMisses) {
    Random random(3);
    std::vector<FloatBox> boxes;
    for (int i = 0; i < 100'000; ++i) boxes.push_back(boxAround(somewhere(random, 1), 0.01, random));
    const Bvh tree(boxes);
    const PaddedSegment segment{{-1, -0.9, -0.8}, {1, 0.7, 0.9}, glm::dvec3(0)};
    // It meets about a dozen boxes, and leaves of four are some times as wide as a box.
    EXPECT_LT(visited(tree, segment).size(), boxes.size() / 100);
}

TEST(Bvh, VisitsTheNearestFirstAndNothingBeyondTheEnd) {
    std::vector<FloatBox> boxes;
    for (int i = 0; i < 256; ++i)
        boxes.push_back({glm::vec3(static_cast<float>(i), 0, 0), glm::vec3(static_cast<float>(i) + 0.5F, 1, 1)});
    PaddedSegment segment{{-1, 0.5, 0.5}, {257, 0.5, 0.5}, glm::dvec3(0)};
    std::uint32_t most = 0;
    EXPECT_FALSE(Bvh(boxes).visit(segment, [&](std::uint32_t primitive) {
        most = std::max(most, primitive);
        segment.last = std::min(segment.last, (primitive + 1.0) / 258);
        return false;
    }));
    EXPECT_LE(most, 8U) << "the leaf of the nearest box and a neighbour";
    EXPECT_TRUE(Bvh(boxes).visit(segment, [](std::uint32_t) { return true; }));
}

TEST(Bvh, HoldsEachPrimitiveOnce) {
    Random random(4);
    std::vector<FloatBox> boxes; // enough for threads to share
    for (int i = 0; i < 60'000; ++i) boxes.push_back(boxAround(somewhere(random, 1), 0.02, random));
    const Bvh tree(boxes);
    const auto order = [&] {
        std::vector<std::uint32_t> all;
        tree.visitBoxes(Shaft(), [&](std::uint32_t primitive) { all.push_back(primitive); });
        return all;
    };
    std::vector<std::uint32_t> once = order();
    std::ranges::sort(once);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) ASSERT_EQ(once[i], i);
    Shaft inside;
    inside.add({{-1, 0, 0}, 0, 0});     // x ≤ 0
    inside.add({{0, 1, 0.5}, -0.2, 0}); // y + z / 2 ≥ 0.2
    std::set<std::uint32_t> some;
    tree.visitBoxes(inside, [&](std::uint32_t primitive) { some.insert(primitive); });
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (inside.meets(boxes[i])) {
            ASSERT_TRUE(some.contains(i)) << i;
        }
}

} // namespace
} // namespace shadowbench::groundtruth::geometry
