// Exact polygons as text: well-known text (WKT) and SVG.
#pragma once

#include "groundtruth/cgal/plan/plan_view.h"
#include "groundtruth/cgal/plan/shadow_polygons.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::groundtruth::plan {

/// One line without an end: `MULTIPOLYGON (((u v, …), (hole), …), …)` or `MULTIPOLYGON EMPTY`, 17 significant digits, every
/// ring closed by its first point, outer rings counter-clockwise and holes clockwise.
std::string wkt(const std::vector<PlanarPolygon>& polygons);

/// What a picture of a receiver shows.
struct PolygonPicture {
    std::string title;
    std::string fill; // colour of `region`
    const ReceiverRegion& receiver;
    const ReceiverRegion& region;
    std::optional<glm::dvec2> lightFoot; // a dot, if it lies in the receiver's box
};

/// One user unit is one metre; v runs down the page, but up if it is the world's y. The description of the picture states
/// how (u, v) lies in the world.
std::string svg(const PolygonPicture& picture);

/// Writes for every planar receiver of `primary` (ExactScene::planarReceivers) `shadow-ID.wkt` and `shadow-ID.svg`, ID being
/// the surface id; further planes of one surface are `shadow-ID-2`, `shadow-ID-3`, … in their order. Area lights cast the
/// hard shadows of their centre. Returns the files written. Throws BadInput if no receiver is planar and InternalError when
/// a file cannot be written.
std::vector<std::filesystem::path> writeShadowPolygons(const Snapshot& snapshot, const PrimaryHits& primary,
                                                       const std::filesystem::path& folder);

/// The same for what a point light sees of the horizontal receivers in a plan-view scene, as `visible-ID`. Throws BadInput
/// for any other scene (planView).
std::vector<std::filesystem::path> writeVisiblePolygons(const Snapshot& snapshot, const PrimaryHits& primary,
                                                        const std::filesystem::path& folder);

} // namespace shadowbench::groundtruth::plan
