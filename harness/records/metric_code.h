// What code that measures and scores, where it differs, leaves to be said of a technique.
#pragma once

#include "harness/records/record.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace shadowbench::gate {

/// Which metrics two versions of the code give alike, as far as results say whose images are the same under both.
class MetricCode {
public:
    /// Learns from a result under two versions; one whose images or truths differ says nothing.
    void take(const Record& before, const Record& now);

    /// Why a change of a metric says nothing of the technique: it was scored against another truth; images and truth are the
    /// same; or the code differs and is not known to score this metric alike, of work to count it alike anywhere (a
    /// technique may do with less and show the same). `sameImages` of all seeds; `same`: the metric has not changed.
    [[nodiscard]] std::optional<std::string> whyUnjudged(const metrics::Metric& metric, const Record& before,
                                                         const Record& now, bool sameImages, bool same) const;

private:
    struct Seen {
        bool alike = false, unlike = false;
    };

    [[nodiscard]] Seen seen(const metrics::Metric& metric, const Record& before, const Record& now) const;

    std::map<std::tuple<std::string_view, std::string, std::string>, Seen> seen_; // by path and both versions
};

} // namespace shadowbench::gate
