// Blockers are told from receivers by their bounding boxes.
#include "scene/meshes/primitives.h"
#include "techniques/shared/casters/blockers.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::techniques {
namespace {

void add(Snapshot& snapshot, const glm::vec3& size, const glm::dvec3& at, double turn = 0) {
    const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1), at), glm::radians(turn), glm::dvec3(0, 1, 0));
    const auto id = static_cast<std::uint32_t>(snapshot.batches.size() + 1);
    snapshot.batches.push_back({std::make_shared<Mesh>(box(size)), {}, false, {{place, place, id}}});
}

/// A ground of 12 × 12 m with its top at y = 0, under a light above its rim that shines on it from the side.
Snapshot ground() {
    Snapshot snapshot;
    snapshot.light = {LightKind::Rectangle, {-6, 8, 0}, {0, -1, 0}, {1, 0.5, 0}, {0, 0, 1}};
    add(snapshot, {12, 0.2F, 12}, {0, -0.1, 0});
    return snapshot;
}

using Flags = std::vector<bool>;

TEST(Blockers, WhatStandsOnTheGroundIsOneAndTheGroundIsNot) {
    Snapshot snapshot = ground();
    add(snapshot, {1, 1, 1}, {2, 0.5, 3}, 30);
    add(snapshot, {1, 1, 1}, {-4, 2.5, 1}, 10);
    EXPECT_EQ(blockers(snapshot), Flags({false, true, true}));
}

TEST(Blockers, WhatIsSunkByATenthStillStandsOnTheGround) {
    Snapshot snapshot = ground();
    add(snapshot, {1, 1, 1}, {2, 0.41, 3});
    EXPECT_EQ(blockers(snapshot), Flags({false, true}));
    add(snapshot, {1, 1, 1}, {-2, 0.35, 3}); // by more: the ground may hide it
    EXPECT_EQ(blockers(snapshot), Flags({true, true, true}));
}

TEST(Blockers, ALargePlateIsOneThoughTheGroundsMiddleLiesBesideIt) {
    Snapshot snapshot = ground();
    add(snapshot, {20, 0.002F, 40}, {10.3, 2, 0});
    EXPECT_EQ(blockers(snapshot), Flags({false, true}));
}

} // namespace
} // namespace shadowbench::techniques
