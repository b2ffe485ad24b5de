// Which pipelines the frames of a variant use.
#pragma once

#include "gpu/observer.h"
#include "scene/scene.h"
#include "techniques/contract/entry.h"

#include <string>
#include <vector>

namespace shadowbench::shaders {

struct FrameUses {
    std::vector<gpu::Use> uses;
    std::vector<gpu::Move> moves;                // of the steady frame
    bool isCounted = false;                      // how often waves take its loops and branches: llvmpipe draws
    std::vector<gpu::Use> largerDispatches = {}; // of the steady frame on a larger image (largerBy)

    /// The same dispatch among these; null where it is none.
    [[nodiscard]] const gpu::Use* larger(const gpu::Use& use) const;
};

/// Renders still frames, the first of which does what is done once, and one in which things move, and returns what the
/// steady frame uses, in order, then what only the others use, with 0 draws. Of levels of detail the steady frame is the one
/// with most transitions. Needs a GL context.
FrameUses pipelinesOf(const Scene& scene, const techniques::Variant& variant);

/// A hash of the sources that this depends on, built-in scenes among them.
std::string drawingSources();

} // namespace shadowbench::shaders
