// How far the shadow of coarser casters is from that of the finest, and how far it may be.
#pragma once

#include "studies/recommend/shadow_patterns.h"
#include "studies/recommend/shadows.h"

#include <map>
#include <string>
#include <vector>

namespace shadowbench::recommend {

/// Metric (docs/metrics.md) → value; the less the better. Hard lights: mismatch, false_shadow, leak. Area lights: rmse, mae,
/// bad30, bad8, and where there is a penumbra penumbra_rmse, an umbra umbra_leak.
using Errors = std::map<std::string, double>;

/// Over the pixels that both label. A share of no pixels is left out.
Errors hardErrors(const LabelErrors& labels);
Errors hardErrors(const Shadow& shadow, const Shadow& exact);
Errors softErrors(const Shadow& shadow, const Shadow& exact, const Receivers& receivers);

/// Whether no error lies above its tolerance; one that could not be measured does not.
bool within(const Errors& errors, const Errors& tolerance);

/// Those of the scene's tolerances that the errors of its light are measured by.
Errors ownTolerance(const Scene& scene);

/// Each "mismatch=0.01", or a number alone: of mismatch for a hard light, of penumbra_rmse for an area light. Throws
/// BadInput naming the metrics that the light has.
Errors parseTolerance(const std::vector<std::string>& words, const Light& light);

} // namespace shadowbench::recommend
