// What changed from one set of records to another. A change counts when it is larger than what the truth leaves open.
#pragma once

#include "harness/records/comparability.h"
#include "harness/records/presence.h"
#include "harness/records/record.h"
#include "harness/records/rules.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

using metrics::Class;
using metrics::name;

enum class Direction {
    Better,
    Same,
    Worse,
    Unclear,     // measured, but not certain enough to call it worse
    NotCompared, // could not be compared: inconclusive
    Waived,      // worse or not compared, which a waiver of the policy accepts
};

/// What is compared of a metric by `rules`; nothing where they do not judge it or the record lacks it.
std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record, const Rules& rules = ownRules());

/// How much of a change in `metric`, which `rules` judge, from `value` may be the truth's own error, a stray pixel or noise.
/// Of `base` only image size, the sizes of its classes of pixels and the truth that judged the metric count.
double allowanceOf(const metrics::Metric& metric, const Record& base, double value, const Rules& rules = ownRules());

/// Same up to the allowance.
Direction directionOf(double base, double head, double allowance);

struct Change {
    std::string scene, variant;
    std::string metric;
    Class changeClass;
    std::optional<double> base, head; // nothing where the record lacks the metric or there is no record
    double allowance = 0;             // changes up to this are Same
    Direction direction = Direction::Same;
    std::string sentence;  // what changed and by how much, as reports print it
    std::string axis = {}; // of the sweep, for a break point
    std::string file = {}; // of a shader, below techniques/
};

struct Comparison {
    std::vector<Change> changes;
    Presence presence;
};

/// Every metric that `rules` judge and every figure of every cell of either set, in the order of `head`, then what only
/// `base` holds, then the break points of sweeps: one that comes earlier along its axis is Worse. Cells are matched by
/// scene, variant, profile, size, seed and place in a sweep; one that was measured with several seeds on both sides is
/// compared by its means and by how much its seeds scatter.
///
/// NotCompared is what is not there on both sides (harness/records/presence.h), the scores of cells that cannot be compared
/// (harness/records/comparability.h), instructions counted in different surroundings, and a score that is another one
/// though images and truth are the same: what draws has not changed it. Where the code that measures and scores differs, a
/// metric of other images is compared if all cells with equal images score it alike, and NotCompared if one does not or
/// there is none; of work, one that counts alike is enough, for a technique may do with less and show the same.
Comparison compare(const std::vector<Record>& base, const std::vector<Record>& head, const Rules& rules = ownRules(),
                   const std::optional<std::vector<Expected>>& expected = {});

/// Why comparing the two decides nothing, as a sentence: they are of one program (which `sameProgramIsMeant` allows, and
/// which may have scored two versions of another renderer), or no cell is scored in both. Nothing where it decides
/// something.
std::optional<std::string> whyMeaningless(const std::vector<Record>& base, const std::vector<Record>& head,
                                          bool sameProgramIsMeant);

/// Whether all records of both are known to be of one program, though perhaps of different commits.
bool sameProgram(const std::vector<Record>& base, const std::vector<Record>& head);

} // namespace shadowbench::gate
