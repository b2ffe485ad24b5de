// What measuring a cell's cost gives.
#pragma once

#include "harness/records/record.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace shadowbench {

struct Time {
    double median = 0, p95 = 0, mad = 0; // ms a frame, G-buffer included
    double ratio = 1;                    // to sm-uniform in the same interleaved rounds, both with the G-buffer
    double floorRatio = 0;               // share of the frame that the G-buffer alone takes
    std::optional<double> baseRatio;     // to the technique's own base (history over its base map)
    std::optional<double> bare;          // ms of the least that it needs, G-buffer included
    std::optional<double> bareRatio;     // to that, without the processor's share
    double processorShare = 0;           // of the frame's time, in passes of the processor
    std::vector<double> samples;
};

struct Work {
    std::uint64_t fragments = 0, vertices = 0, primitives = 0, draws = 0, passes = 0, bytes = 0;
};

/// Frames of a level-of-detail technique over the scene's walk, each timed beside lod-switch's, without the G-buffer; of a
/// rasteriser that draws on the calling thread its processor time, which other programs do not disturb.
struct LodTime {
    double median = 0; // ms a frame
    double ratio = 1;  // to lod-switch: median over the frames
    double spread = 0; // median change from one frame to the next, as a share of the former
};

void setWork(Record& record, const Work& work);
void setTime(Record& record, const Time& time);
void setTime(Record& record, const LodTime& time);

} // namespace shadowbench
