// What tables, charts and the page read out of records.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// Scene ids in the order they first occur.
std::vector<std::string> scenes(const std::vector<Record>& records);

/// Indices of the records of `scene`, in order.
std::vector<std::size_t> ofScene(const std::vector<Record>& records, const std::string& scene);

/// A record's place on the accuracy–cost plane; nothing unless it was scored and timed.
struct Place {
    double error;          // headline
    double cost;           // ratio to sm-uniform
    double costSpread = 0; // the cost lies within cost · (1 ± costSpread): the interval of the rounds' median
};
std::optional<Place> place(const Record& record);

/// Half the 95 % interval of the median of the rounds' times (by order statistics), as a share of the median; 0 where the
/// record has no rounds.
double costSpread(const Record& record);

/// Whether `a` beats `b`: it is at most as wrong, and cheaper by more than both intervals; or less wrong, and not dearer by
/// more than both intervals.
bool dominates(const Place& a, const Place& b);

/// A technique that draws no shadow: what others are measured from.
bool isBaseline(const Record& record);

/// A record of the front deserves a mark if its error is within so many times the scene's tolerance, or there is none.
inline constexpr double markedWithin = 10;

/// Of a table's row: ● on the Pareto front, ○ there for a baseline or an error beyond `markedWithin`, "" off it.
std::string frontMark(const std::vector<Record>& records, const std::string& scene, std::size_t index);

/// The scene's tolerance, from the first of its records that states one.
struct Tolerance {
    std::string metric;
    double value;
};
std::optional<Tolerance> tolerance(const std::vector<Record>& records, const std::string& scene);

/// The headline metric of `scene`'s records; "" if none was scored.
std::string headlineMetric(const std::vector<Record>& records, const std::string& scene);

/// "error = mismatching pixels", "error = rms error of visibility".
std::string meaning(const std::string& metric);

bool isShare(const std::string& metric); // shown in per cent

/// 31.2 %, 4.87 %, 0.09 %, < 0.01 % …; a share of exactly nothing is 0.00 %.
std::string percent(double share);

/// A value of `metric` as tables show it: per cent for shares, four decimals for others.
std::string formatValue(const std::string& metric, double value);

/// A tolerance as written in a scene: "0.5 %", "0.05".
std::string formatBound(const Tolerance& limit);

/// "256²", "800 × 600".
std::string imageSize(const Record& record);

/// Text with Markdown's own characters escaped: | * _ < > `.
std::string markdownText(const std::string& text);

/// "exact (polygon)", "POV-Ray 1024 samples, σ 0.0006".
std::string truth(const ReferenceInfo& reference);

} // namespace shadowbench::report
