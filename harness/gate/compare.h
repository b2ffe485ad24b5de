// What changed from one set of records to another. A change counts when it is larger than what the truth leaves open.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gate {

/// What a metric is about: verdicts of different classes are never merged (METRICS.md).
enum class Class {
    Labels,       // lit or shadowed, all in one
    FalseShadow,  // acne, too much shadow
    Leak,         // light where there is none
    Edge,         // where the shadow's edge lies
    Penumbra,     // graded visibility
    Colour,       // pictures of levels of detail
    Flicker,      // stability over time
    BreakPoint,   // stability over parameters
    Instructions, // cost, the same in every run
    Status,       // a cell that is no longer scored, or no longer there
};
std::string_view name(Class c);

enum class Direction { Better, Same, Worse };

struct Change {
    std::string scene, variant;
    std::string metric;
    Class changeClass;
    std::optional<double> base, head; // nothing where the record lacks the metric or there is no record
    double allowance = 0;             // changes up to this are Same
    Direction direction = Direction::Same;
    std::string sentence; // for people: what changed, by how much
};

/// Every watched metric of every cell of either set, in the order of `head`, then what only `base` holds, then the break
/// points of sweeps: one that comes earlier along its axis is Worse. Cells are matched
/// by scene, variant, profile, size, seed and place in a sweep. A metric or cell that only one side has is Worse when the
/// head lost it and Same when it is new. Throws Inconclusive when instructions were counted in different environments
/// (rasteriser, vector width, Valgrind, processor), and when matched cells were scored against different truths.
std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::gate
