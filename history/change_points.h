// Where series of figures change their level: pure functions. Positions are indices of the first figure of a new level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace shadowbench::history {

/// Figures that are the same in every run of the same program: position i is a change when `values[i]` lies further from the
/// figure before, or from the first of the present level, than `allowances` says for that one. So a slow drift is a change
/// as soon as its steps sum up to more than the allowance. `allowances` has as many elements as `values`.
std::vector<std::size_t> levelChanges(const std::vector<double>& values, const std::vector<double>& allowances);

/// Figures with noise, of any distribution but independent: a machine that drifts makes changes, too.
struct Noisy {
    std::vector<double> values;
    std::vector<std::size_t> commits; // that each is of, in rising order: figures of one commit are never split
};

/// How figures with noise are judged.
struct NoiseRule {
    double falseDiscoveries = 0.05; // expected share of false ones among the series that are said to change
    std::size_t shortest = 3;       // figures in a level at least
    /// Random orders of each series. The number of false discoveries is known to one in so many, whatever the number of
    /// series: of one discovery, to a twentieth of what is allowed.
    int orders = 400;
    std::uint64_t seed = 2014; // of the orders: the same series give the same answer
};

/// How much the figures differ between the stretches that begin at 0 and at `starts` (one or two, in rising order), compared
/// with how much within: the ratio F of Rizzo and Székely, "DISCO analysis: a nonparametric extension of analysis of
/// variance", Ann. Appl. Stat. 4, 2010, exponent 1. It does not depend on the unit of the figures; infinite where those of
/// each stretch are equal, and 0 where all are.
double energyRatio(const std::vector<double>& values, const std::vector<std::size_t>& starts);

struct NoiseChanges {
    std::vector<std::vector<std::size_t>> changes; // of each series, in rising order
    double leastRatio = 0;                         // which a single series that changes must exceed
};

/// The changes of many series: E-divisive (Matteson and James, JASA 109, 2014, 3.1) with two departures. A series is split
/// where F is largest, into two stretches or three, so that a level that is soon left again is seen as well. And series are
/// judged together: as F has no unit, the number of series without a change whose F reaches a value is expected to be the
/// number of random orders, of all series, whose F does, divided by that of orders a series (Tusher, Tibshirani and Chu,
/// PNAS 98, 2001); the series with the largest F are taken as long as that is the allowed share of them (Benjamini and
/// Hochberg 1995). By its own orders alone no series of n figures could be rarer than its share of them, 2 / C(n, k) for k
/// figures of a new level, which among thousands of series is nothing rare. The parts of what was split are judged in the
/// same way, as a family of their own (Yekutieli 2008), until nothing more is found.
NoiseChanges distributionChanges(const std::vector<Noisy>& series, const NoiseRule& rule);

/// The smallest rise (as a summand, from `from` on in steps of 2 %) of the newest figures, `shortest` of them or what their
/// commits have more, whose F exceeds `leastRatio`. Nothing where too few figures are before them.
std::optional<double> smallestRise(const Noisy& series, double from, double leastRatio, const NoiseRule& rule);

} // namespace shadowbench::history
