// What changed from one set of records to another. A change counts when it is larger than what the truth leaves open.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace shadowbench::gate {

/// What a metric is about: verdicts of different classes are never merged (docs/metrics.md).
enum class Class {
    Labels,       // lit or shadowed, all in one
    FalseShadow,  // acne, too much shadow
    Leak,         // light where there is none
    Edge,         // where the shadow's edge lies
    Penumbra,     // graded visibility
    Flicker,      // stability over time
    Colour,       // of levels of detail, against the finest
    BreakPoint,   // stability over parameters
    Instructions, // cost, the same in every run
    Time,         // cost, measured in pairs of frames
    Status,       // a cell that is no longer scored, or no longer there
};
std::string_view name(Class c);

enum class Direction { Better, Same, Worse };

/// Of a metric that is compared with the truth's fractions, how it sums differences up: the truth's σ counts then.
enum class Graded { No, Mean, Rms };

/// A metric that is watched from commit to commit; smaller is better.
struct Watched {
    std::string_view metric; // path in the record
    Class watchedClass;
    std::optional<double> (*value)(const Record&);
    Graded graded = Graded::No;
    double pixels = 0;   // this many pixels of change mean nothing
    double relative = 0; // nor does this share of the base's value
    double absolute = 0; // nor does this much, in the metric's unit
};
std::span<const Watched> watchedMetrics();

/// How much of a change in `metric` from `value` may be the truth's own error, a stray pixel or noise. Of `base` only image
/// size and truth count.
double allowance(const Watched& metric, const Record& base, double value);

/// Same up to the allowance.
Direction directionOf(double base, double head, double allowance);

/// What makes two records of different commits records of the same cell.
using CellKey = std::tuple<std::string, std::string, std::string, int, int, std::uint32_t, std::string, std::string, double>;
CellKey cellOf(const Record& record);

/// What an instruction count depends on beside the program; counts are compared where it is the same.
std::string countingEnvironment(const Environment& environment);

/// What a record was scored against; scores are compared where it is the same.
std::string truthOf(const Record& record);

struct Change {
    std::string scene, variant;
    std::string metric;
    Class changeClass;
    std::optional<double> base, head; // nothing where the record lacks the metric or there is no record
    double allowance = 0;             // changes up to this are Same
    Direction direction = Direction::Same;
    std::string sentence;  // for people: what changed, by how much
    std::string axis = {}; // of the sweep, for a break point
};

/// Every watched metric of every cell of either set, in the order of `head`, then what only `base` holds, then the break
/// points of sweeps: one that comes earlier along its axis is Worse. Cells are matched
/// by scene, variant, profile, size, seed and place in a sweep. A metric or cell that only one side has is Worse when the
/// head lost it and Same when it is new. Throws Inconclusive when instructions were counted in different environments
/// (rasteriser, vector width, Valgrind, processor), and when matched cells were scored against different truths.
std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::gate
