// Hard shadows by 2-D visibility: a third derivation, which shares neither silhouettes nor rays with the others, for scenes
// that are a plan: upright walls and columns that reach from the receiver up to the light
// (docs/ground-truth.md, "2-D visibility").
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/plan/shadow_polygons.h"

#include <vector>

namespace shadowbench::groundtruth::plan {

/// Raise it with every change that can alter a label.
constexpr int codeVersion = 1;

/// A horizontal receiver in coordinates (x, z). Where a footprint covers it, it is in shadow, as it is for the other
/// derivations: the footprint's walls stand between it and the light.
struct PlanView {
    ReceiverRegion receiver;   // the union of its triangles
    ReceiverRegion footprints; // of all casters, wherever they stand
    ReceiverRegion visible;    // what of the receiver the light sees
    ReceiverRegion shadow;     // the rest of the receiver
    glm::dvec2 light{0};       // the light's place in the plan
};

/// Those of the receivers that are exactly horizontal.
std::vector<hard::PlanarReceiver> planReceivers(const Snapshot& snapshot,
                                                const std::vector<hard::PlanarReceiver>& receivers);

/// Throws BadInput, naming the surface and the reason, unless the light is a point light strictly above a horizontal
/// receiver and outside all footprints, and every mesh with a part between the heights of the receiver and the light is
/// closed, has no vertex strictly between them, and only vertical triangles pass from one to the other.
PlanView planView(const Snapshot& snapshot, const hard::PlanarReceiver& receiver);

/// Labels the pixels that see `receiver` as `labelByRegion` does with the plan's shadow. Throws what planView throws.
void labelByPlan(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, const hard::PlanarReceiver& receiver,
                 Reference& out);

} // namespace shadowbench::groundtruth::plan
