// What scores take for near, so that a benchmark can ask what rankings owe to it (benchmarks/rankings.cpp).
#pragma once

#include "harness/metrics/scores.h"

namespace shadowbench::metrics {

/// In pixels.
struct Thresholds {
    double missingEdge = 8; // beyond which an exact edge has nothing of the technique's near it
    double island = 2;      // beyond which a wrong region belongs to no exact edge
    double edgePixel = 0.5; // within which a pixel lies on an exact edge
    int neighbourhood = 2;  // by which a penumbra is dilated and an umbra eroded
};

/// As the functions of scores.h, which have the default thresholds.
LabelErrors labelErrorsBy(const Thresholds& near, const ScoredFrame& frame);
std::optional<EdgeError> edgeErrorBy(const Thresholds& near, const ScoredFrame& frame);
PenumbraErrors penumbraErrorsBy(const Thresholds& near, const ScoredFrame& frame);
std::optional<double> umbraLeakBy(const Thresholds& near, const ScoredFrame& frame);

} // namespace shadowbench::metrics
