// The decision rule of the paired-time tier: is the head slower than the base? Pure functions of samples (docs/gate.md).
#pragma once

#include <vector>

namespace shadowbench::gate {

/// The largest order statistic of `samples` that is at most their distribution's median with probability 1 − `alpha` at
/// least, whatever the distribution (the inverted sign test); −infinity when there are too few for that.
double medianLowerBound(std::vector<double> samples, double alpha);

struct TimeRule {
    double floor = 0.01; // slowdowns up to this are never a regression: machines differ by as much from one hour to the next
    double wallFloor = 0.05; // the same of wall time, in which other processes count, too
    double alpha = 0.01;     // of a false alarm in the whole gate, shared by all cells
    double beta = 0.01;      // of passing a cell early that is slower by more than the floor, each time it is looked at
};

enum class TimeVerdict { Pass, Slower, Unclear };

/// Log-ratios of head to base, one a round. Slower: the one-sided lower bound of their median lies above the floor at
/// `alpha` / `cells`. Unclear: the median does, its bound does not. `looks`: how often the cell
/// may be judged, as one that is unclear is measured again: α is split between them.
TimeVerdict judgeTime(const std::vector<double>& logRatios, const TimeRule& rule, int cells, int looks);

/// Whether no more rounds are needed to pass the cell: the one-sided upper bound of the median lies at or under the floor
/// with probability 1 − β.
bool surelyNotSlower(const std::vector<double>& logRatios, const TimeRule& rule);

/// Whether two equal programs were measured as different, in either direction: then the machine cannot be trusted and the
/// gate is inconclusive.
bool controlAlarms(const std::vector<double>& logRatios, const TimeRule& rule, int cells);

} // namespace shadowbench::gate
