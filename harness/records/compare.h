// What changed from one set of records to another. A change counts when it is larger than what the truth leaves open.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::gate {

using metrics::Class;
using metrics::name;

enum class Direction { Better, Same, Worse };

/// What is compared of a metric that has an allowance; nothing where the record lacks it.
std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record);

/// How much of a change in `metric` from `value` may be the truth's own error, a stray pixel or noise. Of `base` only image
/// size and truth count.
double allowanceOf(const metrics::Metric& metric, const Record& base, double value);

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
    std::string sentence;  // what changed and by how much, as reports print it
    std::string axis = {}; // of the sweep, for a break point
};

/// Every metric with an allowance of every cell of either set, in the order of `head`, then what only `base` holds, then the
/// break points of sweeps: one that comes earlier along its axis is Worse. Cells are matched by scene, variant, profile,
/// size, seed and place in a sweep. A metric or cell that only one side has is Worse when the head lost it and Same when it
/// is new. Throws Inconclusive when instructions were counted in different environments (rasteriser, vector width, Valgrind,
/// processor), and when matched cells were scored against different truths.
std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::gate
