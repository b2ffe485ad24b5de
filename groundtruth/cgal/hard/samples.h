// The N-sample oracle: what surface points see of a list of light points, each decided exactly. For what must equal the
// truth of its own light samples, whatever it owes to the light's whole area.
#pragma once

#include "base/image.h"
#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace shadowbench::groundtruth::hard {

/// By pixel, row 0 at the top; 0 off the receivers.
struct SampledVisibility {
    Image<float> share; // of the light points that the pixel's surface point sees, in [0, 1]
    Image<std::uint32_t>
        undecided; // how many of them touch nothing but an occluder's border: seen, and neither label is right
};

/// The receivers of `primary`, which is of `snapshot` and of `size`, against `lights` in world metres: points on the side of
/// each receiver that the eye sees, as all points of the snapshot's own area light are. `threads` does not change the
/// result. Throws InternalError without light points and for a size that is not that of the primary hits.
SampledVisibility visibleShare(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary,
                               std::span<const glm::dvec3> lights, int threads = 2, const Progress& progress = {});

} // namespace shadowbench::groundtruth::hard
