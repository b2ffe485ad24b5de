// Blockers in clusters of like depth, each taken for one plane that is parallel to the light (Soler and Sillion 1998). No
// GL.
#pragma once

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

struct Clusters {
    std::vector<int> of;               // the cluster of each blocker
    std::vector<BlockerDepths> ranges; // of each cluster
};

/// Begins with one cluster and splits the one with the widest spread at the widest gap between its blockers' middles, until
/// none that holds several spreads more than `tolerance` (1/m) or there are `most`. None without blockers.
Clusters clustered(const std::vector<BlockerDepths>& blockers, double tolerance, int most);

} // namespace shadowbench::techniques
