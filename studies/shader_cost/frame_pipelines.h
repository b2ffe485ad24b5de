// Which pipelines the frames of a variant use.
#pragma once

#include "gpu/observer.h"
#include "scene/scene.h"
#include "studies/shader_cost/shader_cost.h"
#include "techniques/contract/entry.h"

#include <set>
#include <string>
#include <vector>

namespace shadowbench::shaders {

struct FrameUses {
    std::vector<gpu::Use> uses;
    std::vector<gpu::Move> moves;                // of the steady frame
    bool isCounted = false;                      // how often waves take its loops and branches: llvmpipe draws
    std::vector<gpu::Use> largerDispatches = {}; // of the standing frame on a larger image (largerBy)
    std::string frame = {};                      // hash of what the steady frame shows: camera, light and meshes
    std::set<std::string> shaderFiles = {};      // that were compiled for it, by their names

    /// The same dispatch among these; null where it is none.
    [[nodiscard]] const gpu::Use* larger(const gpu::Use& use) const;
};

/// Renders still frames, the first of which does what is done once, and one in which things move, and returns what the
/// counted frame uses, in order, then what only the others use, with 0 draws. Of levels of detail the counted frame is the
/// one with most transitions. Needs a GL context.
FrameUses pipelinesOf(const Scene& scene, const techniques::Variant& variant, CountedFrame counted = CountedFrame::Standing);

/// What this depends on of the program beside shaders, built-in scenes among it: a hash of sources …
std::string drawingSources();

/// … and one of the texts that shaders of these names have in the program.
std::string textsOf(const std::set<std::string>& shaderFiles);

} // namespace shadowbench::shaders
