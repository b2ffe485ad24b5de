// Where a series of figures changes its level: pure functions. Positions are indices of the first figure of a new level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowbench::history {

/// Figures that are the same in every run of the same program: position i is a change when `values[i]` lies further from the
/// first value of the present level than `allowances` says for that one. So a slow drift is a change as soon as its steps
/// sum up to more than the allowance. `allowances` has as many elements as `values`.
std::vector<std::size_t> levelChanges(const std::vector<double>& values, const std::vector<double>& allowances);

/// How figures with noise are judged.
struct NoiseRule {
    double alpha = 0.01;       // of a false alarm in a series without a change
    std::size_t shortest = 3;  // figures in a level at least
    std::uint64_t seed = 2014; // of the permutations: the same series gives the same answer
};

/// Twice the mean distance between a figure before `split` and one after it less the mean distances within both parts,
/// scaled by their sizes m, n: Q = mn/(m + n) Ê (Matteson and James, "A nonparametric approach for multiple change point
/// analysis of multivariate data", JASA 109, 2014, eq. 5 to 7, exponent 1). Both parts hold two figures at least.
double energyStatistic(const std::vector<double>& values, std::size_t split);

/// E-divisive (Matteson and James 2014, 3.1): the split with the largest Q is a change when a random order of the figures
/// has as large a Q with a probability of `alpha` at most; then both parts are searched. Departures from the paper: a part
/// runs to its end, as in Daly et al., "The use of change point detection to identify software performance regressions in a
/// continuous integration system", ICPE 2020; and parts are judged each on its own.
/// `groups[i]` says which commit figure i is of, in rising order: figures of one commit are never split. The
/// figures may have any distribution but must be independent: a machine that drifts makes changes, too. As a permutation can
/// be no rarer than its share, k figures of a new level among n can be distinguished from chance when alpha exceeds about 2
/// / C(n, k).
std::vector<std::size_t> distributionChanges(const std::vector<double>& values, const std::vector<std::size_t>& groups,
                                             const NoiseRule& rule);

} // namespace shadowbench::history
