// What changed from one set of records to another. A change counts when it is larger than what the truth leaves open.
#pragma once

#include "harness/records/comparability.h"
#include "harness/records/record.h"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::gate {

using metrics::Class;
using metrics::name;

enum class Direction {
    Better,
    Same,
    Worse,
    Unclear,  // measured, but not certain enough to call it worse
    Unjudged, // could not be compared: inconclusive
};

/// What is compared of a metric that has an allowance; nothing where the record lacks it.
std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record);

/// How much of a change in `metric` from `value` may be the truth's own error, a stray pixel or noise. Of `base` only image
/// size, the sizes of its classes of pixels and the truth that judged the metric count.
double allowanceOf(const metrics::Metric& metric, const Record& base, double value);

/// Same up to the allowance.
Direction directionOf(double base, double head, double allowance);

/// What makes two records of different commits records of the same cell.
using CellKey = std::tuple<std::string, std::string, std::string, int, int, std::uint32_t, std::string, std::string, double>;
CellKey cellOf(const Record& record);

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

/// Every metric with an allowance and every figure of every cell of either set, in the order of `head`, then what only
/// `base` holds, then the break points of sweeps: one that comes earlier along its axis is Worse. Cells are matched by
/// scene, variant, profile, size, seed and place in a sweep; one that was measured with several seeds on both sides is
/// compared by its means, and what its seeds differ by is allowed. A metric or cell that only one side has is Worse when the
/// head lost it and Same when it is new.
///
/// Unjudged are the scores of cells that cannot be compared (harness/records/comparability.h), and instructions counted in
/// different surroundings. Where the metrics' code differs, both sides have scored the same images wherever a technique
/// shows what it showed: there every difference is the code's, and Unjudged; elsewhere a metric is compared if all such
/// cells score it alike, and Unjudged if one does not or there is none.
std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head);

/// Why comparing the two decides nothing, as a sentence: they are of one program (which `sameProgramIsMeant` allows, and
/// which may have scored two versions of another renderer), or no cell is scored in both. Nothing where it decides
/// something.
std::optional<std::string> whyMeaningless(const std::vector<Record>& base, const std::vector<Record>& head,
                                          bool sameProgramIsMeant);

/// Whether all records of both are known to be of one program, though perhaps of different commits.
bool sameProgram(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::gate
