// Scores of hard labels.
#include "harness/metrics/pixels.h"
#include "harness/metrics/thresholds.h"

#include <cmath>

namespace shadowbench::metrics {
namespace {

/// Wrong pixels of a class and all of that class.
struct Tally {
    std::size_t wrong = 0, all = 0;
    void add(bool isWrong) {
        ++all;
        if (isWrong) ++wrong;
    }
    [[nodiscard]] std::optional<double> share() const {
        if (all == 0) return {};
        return static_cast<double>(wrong) / static_cast<double>(all);
    }
};

struct HardTally {
    Tally all, offEdge, lit, shadowed;
    double distance = 0; // of V from the label, summed up
};

HardTally tally(const ScoredFrame& frame, const Thresholds& near = {}) {
    const auto& [v, truth, mask] = frame;
    HardTally result;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (!mask.scored[i]) continue;
        const bool lit = isLit(truth.visibility[i]);
        const bool wrong = isLit(v[i]) != lit;
        result.all.add(wrong);
        result.distance += std::abs(static_cast<double>(v[i]) - truth.visibility[i]);
        (lit ? result.lit : result.shadowed).add(wrong);
        if (truth.edgeDistance[i] > near.edgePixel) result.offEdge.add(wrong);
    }
    return result;
}

} // namespace

LabelErrors labelErrors(const ScoredFrame& frame) { return labelErrorsBy({}, frame); }

LabelErrors labelErrorsBy(const Thresholds& near, const ScoredFrame& frame) {
    requireComparable(frame);
    const HardTally counts = tally(frame, near);
    LabelErrors errors{counts.all.share(), {}, counts.offEdge.share(), counts.lit.share(), counts.shadowed.share()};
    if (counts.all.all > 0) errors.unrounded = counts.distance / static_cast<double>(counts.all.all);
    return errors;
}

LabelledPixels labelledPixels(const ScoredFrame& frame) {
    requireComparable(frame);
    const HardTally counts = tally(frame);
    const auto all = [](const Tally& t) { return static_cast<double>(t.all); };
    return {all(counts.all), all(counts.lit), all(counts.shadowed), all(counts.offEdge)};
}

} // namespace shadowbench::metrics
