// Blockers in clusters of like depth, each taken for one plane that is parallel to the light (Soler and Sillion 1998). No
// GL.
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowbench::techniques {

/// Nearest and farthest depth of a blocker along the light's axis, both positive, in metres.
struct BlockerDepths {
    double near, far;

    /// What the widths of the penumbrae that it casts may differ by, in 1/m: its plane may be anywhere in between.
    [[nodiscard]] double spread() const { return 1 / near - 1 / far; }

    /// The depth whose penumbrae are halfway between those of both ends.
    [[nodiscard]] double middle() const { return 2 / (1 / near + 1 / far); }
};

/// A triangle that blocks light, with the id of its surface.
struct BlockerPolygon {
    BlockerDepths depths;
    std::uint32_t surface;
    std::uint32_t number; // in its mesh
};

/// The triangles of the placements that are `shown` (counted through the snapshot's batches) as `view` sees them. Of a
/// closed mesh, those that face the light's centre: the others have the same image.
std::vector<BlockerPolygon> blockerPolygons(const Snapshot& snapshot, const LightView& view, const std::vector<bool>& shown);

/// Triangles of like depth. Clusters of one group share a range of depth and lie next to each other in the list.
struct Cluster {
    std::vector<std::size_t> members; // numbers in the list of polygons
    BlockerDepths range;
    std::size_t group;
};

/// Begins with one cluster and splits the one with the widest spread until none that can be split spreads more than
/// `tolerance` (1/m) or there are `most`. A group whose surfaces leave a gap in depth becomes two at its widest gap.
/// Otherwise it is split in the middle of its depths: the group into two, each surface going where its own middle lies, if
/// either spreads clearly less then; or the cluster, each triangle going where its own lies, if both do. Where triangles are
/// too elongated for that, their surfaces become a group of their own, beside others of their depths. None without polygons.
std::vector<Cluster> clustered(const std::vector<BlockerPolygon>& polygons, double tolerance, std::size_t most);

} // namespace shadowbench::techniques
