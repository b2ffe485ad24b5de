// Exact hard shadows with CGAL, behind plain types (GROUNDTRUTH.md: "CGAL hard shadows").
#pragma once

#include "groundtruth/reference.h"

namespace shadowbench::groundtruth {

/// What every pixel centre sees, decided exactly (Camera::ray defines the ray; ties at equal depth go to the lower id).
PrimaryHits primaryHits(const Snapshot& snapshot, glm::ivec2 size, const Progress& progress = {});

/// Exact labels at the receivers of `primary` by shadow rays: 1 lit, 0 shadowed; `surface` becomes OnEdge where the segment to the
/// light only touches an occluder's border. Point and directional lights.
void labelByRays(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress = {});

/// The same by silhouette chains and an exact scanline, plus exact edge distances, for the receivers of one planar placement
/// (surface id `receiver`, all of whose visible pixels lie in one plane); other pixels of `out` are left alone.
/// Throws InternalError if that placement is not planar as seen.
void labelByPolygon(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, std::uint32_t receiver, Reference& out,
                    const Progress& progress = {});

/// Surface ids whose visible receiver pixels all lie in one plane (a ground, one face of a box): where `polygon` applies.
std::vector<std::uint32_t> planarReceivers(const Snapshot& snapshot, const PrimaryHits& primary);

/// Versions for the provenance and the key: CGAL's and of this code.
std::map<std::string, std::string> exactTools();

}  // namespace shadowbench::groundtruth
