// Figures of one metric of one cell over commits.
#pragma once

#include "harness/records/compare.h"
#include "history/store.h"

#include <string>
#include <vector>

namespace shadowbench::history {

/// What is looked at; an empty list: everything. Patterns with * and ?.
struct Selection {
    std::vector<std::string> metrics; // paths in the record
    std::vector<std::string> scenes;
    std::vector<std::string> techniques; // ids or variants
};

struct Point {
    std::size_t commit; // index in the history's commits
    double value;
    double allowance; // a change of another figure from this one means nothing up to it
};

struct Series {
    std::string scene, variant, metric;
    std::string cell; // what else distinguishes it: profile, size, seed, place in a sweep
    gate::Class metricClass;
    bool noisy; // another run of the same commit gives another figure
    /// Why its figures cannot be compared with earlier ones of the same metric and cell; "" where these are the first.
    std::string apart;
    /// By commit. Of a metric without noise one a commit, its last; else one a record.
    std::vector<Point> points;
};

struct History {
    std::vector<Commit> commits; // without records, oldest first
    std::vector<Series> series;  // by scene, metric, variant, cell; what cannot be compared by its first commit
};

/// The series of scored cells: every metric that has an allowance, every cost that is timed and judged, and whether a cell
/// is in error. Smaller is better throughout. Two records are of one series when the gate would compare them
/// (harness/records/comparability.h), costs when they were also taken in the same surroundings.
History historyOf(const std::vector<Commit>& commits, const Selection& selection);

} // namespace shadowbench::history
