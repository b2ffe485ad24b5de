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
    double mustTell = 0.05;  // a cell that stays unclear is one only if a slowdown by this would have been told
    double alpha = 0.01;     // of a false alarm in the whole gate, shared by both clocks of all cells
};

enum class TimeVerdict { Pass, Slower, Unclear };

/// Logarithms of the times that the three took in one restart, each in the middle of its rounds; their differences count.
/// Restarts are independent, the rounds of one are not: where a process lies in memory moves its speed.
struct RestartTimes {
    double base = 0, head = 0, control = 0;
};

/// The median of the means of all pairs of `samples`, each with itself, too: their middle (Hodges and Lehmann 1963). Samples
/// must not be empty.
double hodgesLehmann(const std::vector<double>& samples);

/// Estimated logarithm of the head's time over that of base and control. Restarts must not be empty.
double logSlowdown(const std::vector<RestartTimes>& restarts);

/// Probability that chance puts the head as far behind as `restarts` show when it is slower by exp(`logSlowdown`): then any
/// of the three may have been the head in any restart. Quade's test (1979), one-sided and exact: ranks of the three in a
/// restart, weighted by the rank of their range. With blocks of two it would be Wilcoxon's signed-rank test.
double quadeTail(const std::vector<RestartTimes>& restarts, double logSlowdown);

/// The largest logarithm of a slowdown that `quadeTail` refuses at `alpha`; −infinity when there are too few restarts.
double slowdownLowerBound(const std::vector<RestartTimes>& restarts, double alpha);

/// The least slowdown that restarts which scatter like these would have been called slower for in 95 of 100 gates: one that
/// neither passes by chance at the looks so far nor stays unclear at the last of them, after `most` restarts, by a test at
/// `alpha`. Times are taken as normally distributed. At least two restarts.
double smallestTold(const std::vector<RestartTimes>& restarts, const TimeRule& rule, double alpha, int most);

/// Pass: the estimate lies at or under the floor. Slower: it does not, and a slowdown by the floor alone is refused at
/// `alpha` / `cells` / `looks`. Unclear: it is not refused. `looks`: how often the cell may be judged slower, as one
/// that is unclear is measured again: α is split between them.
TimeVerdict judgeTime(const std::vector<RestartTimes>& restarts, const TimeRule& rule, int cells, int looks);

/// Whether two equal programs were measured as different, in either direction: then the machine cannot be trusted and the
/// gate is inconclusive. Log-ratios of control to base, one a round: that rounds of a restart are alike makes it alarm
/// somewhat more often than at α.
bool controlAlarms(const std::vector<double>& logRatios, const TimeRule& rule, int cells);

} // namespace shadowbench::gate
