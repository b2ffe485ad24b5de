// What was measured of one cell: a value for each line of the table, or none.
#pragma once

#include "harness/metrics/table.h"

#include <array>
#include <map>

namespace shadowbench::metrics {

class Values {
public:
    /// The value of a metric; absent where it does not apply.
    std::optional<double>& operator[](MetricId id) { return values_[id.index()]; }
    const std::optional<double>& operator[](MetricId id) const { return values_[id.index()]; }
    const std::optional<double>& operator[](const Metric& line) const { return values_[MetricId(line).index()]; }
    std::optional<double>& operator[](const Metric& line) { return values_[MetricId(line).index()]; }

    /// The numbers of a list; empty where it does not apply.
    std::vector<double>& list(MetricId id) { return lists_[id.index()]; }
    [[nodiscard]] const std::vector<double>& list(MetricId id) const;

    /// Whether one of the lines has a value or a list.
    [[nodiscard]] bool any(std::span<const Metric> lines) const;

    /// Makes a line's value or list absent.
    void clear(const Metric& line);

private:
    std::array<std::optional<double>, table.size()> values_;
    std::map<std::size_t, std::vector<double>> lists_; // by index of the line
};

/// Sets all metrics whose lines say `Kind` (OfLabels, OfMap …) from one frame, walk or set of frames.
template <class Kind, class Frame>
void compute(const Frame& frame, Values& values) {
    Results<Frame> results(frame);
    for (const Metric& line : table)
        if (const Kind* kind = std::get_if<Kind>(&line.computed)) values[line] = kind->value(results);
}

/// Appends a frame's number to all lists whose lines say `Kind` (LabelsByFrame …). Throws BadInput when M is empty.
template <class Kind>
void appendFrame(const ScoredFrame& frame, Values& values);

/// Sets all lists whose lines say ByStillFrame.
void computeLists(const StillFrames& frames, Values& values);

/// The value of a metric by its name for bounds; nothing where it is absent or there is none of that name.
std::optional<double> bounded(const Values& values, std::string_view name);

} // namespace shadowbench::metrics
