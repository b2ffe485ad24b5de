// Where the error of casters' levels is counted.
//
// Casters are exchanged, receivers are not: every choice of levels is judged at the same surface points, those that the
// scene as drawn shows at the pixel centres of a frame. Only surfaces of objects without levels count (a ground, walls). An
// object with levels is drawn at one level and may cast at another; the two surfaces cross, and at its own points, and those
// of the model's other parts that touch it, a label would say which of them lies in front there. What is left of that in a
// picture depends on how a technique keeps surfaces from shadowing themselves (bias, second depth layer, the same level for
// the own shadow), not on the level alone. The shadow that a model throws on another one has the same outline as on the
// ground (tests/cells/caster_levels_test.cpp holds that). And on these receivers either exact oracle answers, so that one
// can verify what the other found.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"
#include "studies/recommend/caster_groups.h"

#include <cstdint>
#include <set>

namespace shadowbench::recommend {

struct Receivers {
    groundtruth::PrimaryHits primary; // of the scene as drawn; Background off the receivers that count
    glm::ivec2 size{0, 0};
    std::set<std::uint32_t> ids; // of surfaces that a pixel which counts sees
    std::size_t pixels = 0;      // that count
    std::size_t all = 0;         // receiver pixels of the frame, objects with levels included
};

/// `drawn` is the scene as drawn at the casters' frame. Throws BadInput when no pixel sees a receiver that counts.
Receivers receivers(const Snapshot& drawn, glm::ivec2 size, const Casters& casters, const Progress& progress = {});

} // namespace shadowbench::recommend
