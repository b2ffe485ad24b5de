// Where the error of casters' levels is counted.
//
// Casters are exchanged, receivers are not: every choice of levels is judged at the same surface points, those that the
// scene as drawn shows at the pixel centres of a frame. Only surfaces of objects without levels count (a ground, walls). An
// object with levels is drawn at one level and may cast at another; the two surfaces cross, and at its own points, and those
// of the model's other parts that touch it, a label would tell which of them lies in front there. What is left of that in a
// picture depends on how a technique keeps surfaces from shadowing themselves (bias, second depth layer, the same level for
// the own shadow), not on the level alone. The shadow that a model throws on another one has the same outline as on the
// ground: at the levels recommended in the gate profile not one pixel of a windmill or tree is wrong by the shadow of
// another (tests/cells/caster_levels_test.cpp), while 1.7 % of the windmills' are by their own rotor or tower. And on these
// receivers either exact oracle answers, so that the one can verify what was found by the other.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"
#include "harness/studies/recommend/caster_groups.h"

#include <cstdint>
#include <set>

namespace shadowbench::adequacy {

struct Receivers {
    groundtruth::PrimaryHits primary; // of the scene as drawn; Background off the receivers that count
    glm::ivec2 size{0, 0};
    std::set<std::uint32_t> ids; // of surfaces that a pixel which counts sees
    std::size_t pixels = 0;      // that count
    std::size_t all = 0;         // receiver pixels of the frame, objects with levels included
};

/// `drawn` is the scene as drawn at the casters' frame. Throws BadInput when no pixel sees a receiver that counts.
Receivers receivers(const Snapshot& drawn, glm::ivec2 size, const Casters& casters, const Progress& progress = {});

} // namespace shadowbench::adequacy
