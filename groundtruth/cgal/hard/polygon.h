// Exact hard-shadow labels and edge distances on one plane, from silhouettes.
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/hard/occluders.h"

namespace shadowbench::groundtruth::hard {

/// Fills visibility, surface and edgeDistance of the pixels that see `receiver`.
void labelPlane(const Occluders& occluders, const Camera& camera, glm::ivec2 size, const PrimaryHits& primary,
                const PlanarReceiver& receiver, EdgeDistances distances, Reference& out, const Progress& progress);

} // namespace shadowbench::groundtruth::hard
