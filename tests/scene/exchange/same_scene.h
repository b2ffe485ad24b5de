// Two scenes are the same where every number in every frame is.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <optional>

namespace shadowbench {

inline void expectSameTrack(const Track& a, const Track& b, const char* what) {
    ASSERT_EQ(a.keys.size(), b.keys.size()) << what;
    for (std::size_t i = 0; i < a.keys.size(); ++i) {
        EXPECT_EQ(a.keys[i].frame, b.keys[i].frame) << what;
        EXPECT_EQ(a.keys[i].value, b.keys[i].value) << what;
    }
}

inline void expectSameMesh(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.closed, b.closed);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
}

/// The frames before, at and after rest, and the placements one frame earlier that techniques with a history need.
inline void expectSameSnapshot(const Snapshot& a, const Snapshot& b) {
    SCOPED_TRACE(a.frame);
    EXPECT_EQ(a.camera, b.camera);
    EXPECT_EQ(a.previousCamera, b.previousCamera);
    EXPECT_EQ(a.light, b.light);
    ASSERT_EQ(a.batches.size(), b.batches.size());
    for (std::size_t i = 0; i < a.batches.size(); ++i) {
        const Batch &one = a.batches[i], &other = b.batches[i];
        expectSameMesh(*one.mesh, *other.mesh);
        EXPECT_EQ(one.colour, other.colour);
        EXPECT_EQ(one.moving, other.moving);
        ASSERT_EQ(one.previousMesh != nullptr, other.previousMesh != nullptr);
        if (one.previousMesh) expectSameMesh(*one.previousMesh, *other.previousMesh);
        ASSERT_EQ(one.placements.size(), other.placements.size());
        for (std::size_t j = 0; j < one.placements.size(); ++j) {
            EXPECT_EQ(one.placements[j].id, other.placements[j].id);
            EXPECT_EQ(one.placements[j].world, other.placements[j].world);
            EXPECT_EQ(one.placements[j].previous, other.placements[j].previous);
        }
    }
}

inline void expectSameExpectations(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.tolerance, b.tolerance);
    const auto same = [](const Expectation& one, const Expectation& other) {
        return one.technique == other.technique && one.bound.metric == other.bound.metric &&
               one.bound.value == other.bound.value && one.bound.below == other.bound.below && one.reason == other.reason;
    };
    EXPECT_TRUE(std::ranges::equal(a.expectations, b.expectations, same));
    EXPECT_TRUE(std::ranges::equal(a.breaks, b.breaks, [](const BreakExpectation& one, const BreakExpectation& other) {
        return one.technique == other.technique && one.axis == other.axis && one.between == other.between &&
               one.reason == other.reason;
    }));
}

inline void expectSameWalk(const std::optional<LodWalk>& a, const std::optional<LodWalk>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(a->frames, b->frames);
    EXPECT_EQ(a->band, b->band);
    expectSameTrack(a->eye, b->eye, "eye of the walk");
    expectSameTrack(a->target, b->target, "target of the walk");
}

inline void expectSameLevels(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const Object &one = a.objects[i], &other = b.objects[i];
        EXPECT_EQ(one.name, other.name);
        EXPECT_EQ(one.colour, other.colour);
        ASSERT_EQ(one.levels.size(), other.levels.size());
        for (std::size_t j = 0; j < one.levels.size(); ++j) {
            EXPECT_EQ(one.levels[j].until, other.levels[j].until);
            EXPECT_EQ(one.levels[j].colour, other.levels[j].colour);
            expectSameMesh(*one.levels[j].mesh, *other.levels[j].mesh);
        }
    }
}

inline void expectSameScene(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.shows, b.shows);
    EXPECT_EQ(a.profile, b.profile);
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.timeline.still, b.timeline.still);
    EXPECT_EQ(a.timeline.moving, b.timeline.moving);
    EXPECT_EQ(a.timeline.approach, b.timeline.approach);
    EXPECT_EQ(a.referenceSamples, b.referenceSamples);
    EXPECT_EQ(a.movingReferenceSamples, b.movingReferenceSamples);
    expectSameExpectations(a, b);
    expectSameWalk(a.lod, b.lod);
    expectSameLevels(a, b);
    expectSameTrack(a.lightCentre, b.lightCentre, "light's centre");
    expectSameTrack(a.lightDirection, b.lightDirection, "light's direction");
    for (int frame = -a.timeline.approach; frame < 0; ++frame) expectSameSnapshot(snapshot(a, frame), snapshot(b, frame));
    for (const int frame : scoredFrames(a)) expectSameSnapshot(snapshot(a, frame), snapshot(b, frame));
}

} // namespace shadowbench
