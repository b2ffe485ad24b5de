// What tables, charts and the page read out of records.
#pragma once

#include "harness/records/record.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// Scene ids in the order they first occur.
std::vector<std::string> scenes(const std::vector<Record>& records);

/// Indices of the records of `scene`, in order.
std::vector<std::size_t> ofScene(const std::vector<Record>& records, const std::string& scene);

/// Those of them that were scored by the scene's headline metric.
std::vector<std::size_t> scoredOf(const std::vector<Record>& records, const std::string& scene);

/// The headline error against the exact visible share, of a record whose headline is against samples of it; nothing where
/// that share is not known at every pixel.
std::optional<double> exactError(const Record& record);

/// For each of the scene's records those that it cannot be told from: by the samples one of the two is better, by the exact
/// share the other. Records that can be told from all others have no entry.
std::map<std::size_t, std::vector<std::size_t>> inseparable(const std::vector<Record>& records, const std::string& scene);

/// "pcss, temporal-soft": the variants of the records at `indices`.
std::string variantsOf(const std::vector<Record>& records, const std::vector<std::size_t>& indices);

/// Half the 95 % interval of the median of the rounds' times, by order statistics, as a share of the median. Of fewer than
/// six rounds it is the range of all, which holds less; of one or none 0.
double spreadOf(std::vector<double> times);

/// What a frame costs, in frames of sm-uniform (of modelled costs: in milliseconds). It lies within ratio · (1 ± spread),
/// the spread of its rounds.
struct FrameCost {
    double ratio;
    double spread = 0;
};

/// That of the frame in motion where it is dearer by more than both intervals, else the standing frame's; the standing one's
/// where that is all the record knows (it is older, or `standing` was asked of it). Nothing where it was not timed, and of
/// other renderers, whose costs are not measured here.
std::optional<FrameCost> frameCost(const Record& record);

/// The standing frame's alone: with what is kept while light and casters stand still.
std::optional<FrameCost> standingCost(const Record& record);

using CostOf = std::function<std::optional<FrameCost>(const Record& record)>;

bool knowsMotion(const Record& record);

/// The frame in motion as a multiple of the standing one, of a record whose technique keeps something while nothing moves:
/// it draws more in motion, or has passes there that the standing frame lacks.
std::optional<double> cacheSaves(const Record& record);

/// The records as those of scenes that stand still: without what they know of motion.
std::vector<Record> standing(std::vector<Record> records);

/// What cost means in tables of these records: "frames of sm-uniform, the dearer of standing and in motion".
std::string costMeaning(const std::vector<Record>& records, const std::string& scene);

/// A record's place on the accuracy–cost plane; nothing unless it was scored and timed.
struct Place {
    double error;          // headline
    double cost;           // FrameCost::ratio
    double costSpread = 0; // FrameCost::spread
};
std::optional<Place> place(const Record& record, const CostOf& costOf = frameCost);

/// Whether `a` beats `b`: it is at most as wrong, and cheaper by more than both intervals; or less wrong, and not dearer by
/// more than both intervals.
bool dominates(const Place& a, const Place& b);

/// A technique that draws no shadow: what others are measured from.
bool isBaseline(const Record& record);

/// A record of the front deserves a mark if its errors are within so many times the scene's tolerances, or there are none.
inline constexpr double markedWithin = 10;

/// Of a table's row: ● on the Pareto front, ○ there for a baseline or an error beyond `markedWithin`, "" off it.
std::string frontMark(const std::vector<Record>& records, const std::string& scene, std::size_t index,
                      const CostOf& costOf = frameCost);

/// Of a record that is off the front although no other is both cheaper and no worse without the costs' spreads: the index
/// of one that errs less, and that it is not surely cheaper than. Nothing for all others.
std::optional<std::size_t> keptOffFrontBy(const std::vector<Record>& records, const std::string& scene, std::size_t index,
                                          const CostOf& costOf = frameCost);

/// The worst error that a viewer of a scene accepts.
struct Tolerance {
    std::string metric; // its name for bounds
    double value;
};

/// The scene's tolerances, by metric, from the first of its records that states any; of a scene that states none the usual
/// ones of its headline metric. Behind them, unless the scene states its own, the shares of the shadow itself that a viewer
/// accepts (docs/metrics.md, "Adequacy"). Empty where no record was scored.
std::vector<Tolerance> tolerances(const std::vector<Record>& records, const std::string& scene);

/// The first that the scene states, which break points are by.
std::optional<Tolerance> tolerance(const std::vector<Record>& records, const std::string& scene);

/// The error of a record that comes nearest to its tolerance, or exceeds it most, as a multiple of it. Metrics that do not
/// apply to the record do not count; nothing if none does.
std::optional<double> shareOfTolerance(const Record& record, const std::vector<Tolerance>& tolerances);

/// Whether it was scored and all its errors that there are tolerances of, one at least, are within them.
bool isWithin(const Record& record, const std::vector<Tolerance>& tolerances);

/// The headline metric of `scene`'s records; "" if none was scored.
std::string headlineMetric(const std::vector<Record>& records, const std::string& scene);

/// "error = mismatching pixels", "error = rms error of visibility".
std::string meaning(const std::string& metric);

bool isShare(const std::string& metric); // shown in per cent

/// 31.2 %, 4.87 %, 0.09 %, < 0.01 % …; a share of exactly nothing is 0.00 %.
std::string percent(double share);

/// A value of `metric` as tables show it: per cent for shares, four decimals for others.
std::string formatValue(const std::string& metric, double value);

/// The error of a scored record as tables show it: "0.54 %"; over seeds with its 95 % interval, over views with the worst:
/// "0.41 % ± 0.03 %", "0.54 %, worst 0.71 %".
std::string errorText(const Record& record);

/// A tolerance as written in a scene: "0.5 %", "0.05"; several with their metrics: "penumbra_rmse 0.05, rmse 0.03".
std::string formatBound(const Tolerance& limit);
std::string formatBounds(const std::vector<Tolerance>& limits);

/// Where a technique fails, as its document says it: "Shades nothing but its plane"; "" for an unknown one.
std::string admittedFailure(const std::string& technique);

/// What other renderers of `scene` say of their own costs: "external:three-pcf 1.25 ms (NVIDIA H100), …"; "" if none does.
std::string reportedCosts(const std::vector<Record>& records, const std::string& scene);

/// What people call a row: "Percentage-closer filtering (kernel=7)", another renderer's own title; the variant where nobody
/// says.
std::string nameForPeople(const Record& record);

/// "256²", "800 × 600".
std::string imageSize(const Record& record);

/// Text with Markdown's own characters escaped: | * _ < > `.
std::string markdownText(const std::string& text);

/// "exact (polygon)", "POV-Ray 1024 samples, σ 0.0006".
std::string truth(const ReferenceInfo& reference);

} // namespace shadowbench::report
