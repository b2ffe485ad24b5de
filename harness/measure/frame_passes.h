// What a shadow technique's frame costs pass by pass.
#pragma once

#include "harness/measure/pass_cost.h"
#include "harness/records/record.h"
#include "harness/render/stage.h"
#include "techniques/contract/entry.h"

#include <cstdint>
#include <vector>

namespace shadowbench::timing {

/// A technique's sequence of frames, whose next one has number `index`.
struct Sequence {
    techniques::Technique& technique;
    int index;
    std::uint32_t seed;
};

/// Renders the sequence's next frame of what the stage shows, G-buffer included.
RenderFrame framesOf(Stage& stage, Sequence& frames);

/// Times the passes of a counted frame over the next frames of what the stage shows.
void timePasses(FramePasses& counted, Stage& stage, Sequence& frames);

/// Pass by pass as records have them. `timed`: with their times.
std::vector<PassRecord> passRecords(const FramePasses& passes, bool timed);

/// Sets the times in `passes` by those of `timed`. Work stays that of the frame that was counted: another frame's may
/// differ, as of a map that is turned from frame to frame.
void addTimes(const std::vector<PassRecord>& timed, std::vector<PassRecord>& passes);

/// The size of another image of a scene: 1024 pixels on its longer side, 256 where the scene's own has as many.
glm::ivec2 otherScreen(const Scene& scene);

/// The variant's frame, still and warm, on that image.
OtherScreen measureOtherScreen(const Scene& scene, const techniques::Variant& variant, int frame, std::uint32_t seed);

} // namespace shadowbench::timing
