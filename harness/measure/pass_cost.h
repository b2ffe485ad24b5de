// The cost of a frame pass by pass, as techniques name their passes (techniques/contract/pass.h).
#pragma once

#include "harness/render/lod_stage.h"
#include "harness/render/stage.h"
#include "techniques/gl/counters.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace shadowbench::timing {

/// A pass of a frame; where it ran several times, all of them together.
struct PassCost {
    std::string name;
    int runs = 0;
    double milliseconds = 0; // see raster_clock.h; with the work of the CPU, and finished before the next pass begins
    gl::WorkCount work;
};

struct FramePasses {
    std::vector<PassCost> passes; // in the order in which they ran first
    PassCost outside;             // what belongs to no pass

    /// All of the frame: the sum of the above.
    [[nodiscard]] PassCost frame() const;

    /// Of the frame's time, the share of passes that ask nothing of the GPU, and of what lies between passes: work of the
    /// processor, such as edges and views. 0 where nothing was timed.
    [[nodiscard]] double processorShare() const;
};

/// Renders one frame whose passes `listener` learns of.
using RenderFrame = std::function<void(techniques::PassListener& listener)>;

/// Renders a frame to count its work, times are 0. Throws InternalError where a pass begins within another.
FramePasses countPasses(const RenderFrame& render);

/// Renders `rounds` ≥ 1 frames more to time the passes of `counted`: medians over these, for a pass over those that it ran
/// in. After the first, none begins once the budget is spent.
void timePasses(FramePasses& counted, const RenderFrame& render, int rounds,
                double budgetMilliseconds = std::numeric_limits<double>::infinity());

/// Renders one frame to time its passes by wall time, those too whose work several threads of the processor share. Counts
/// nothing.
FramePasses timeOnce(const RenderFrame& render);

/// Both.
FramePasses measurePasses(const RenderFrame& render, int rounds);

/// Of a frame of a shadow technique, G-buffer included: the frame that the stage shows, as number `index` and following of
/// the technique's sequence. Shaders should have been compiled.
FramePasses measurePasses(Stage& stage, techniques::Technique& technique, int index, std::uint32_t seed, int rounds);

/// Of the frame that the stage shows, drawn by a level-of-detail technique again and again.
FramePasses measurePasses(lod::LodStage& stage, techniques::LodTechnique& technique, int rounds);

} // namespace shadowbench::timing
