// What measuring a cell's cost gives.
#pragma once

#include "harness/records/record.h"
#include "techniques/gl/counters.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace shadowbench {

struct Time {
    double median = 0, p95 = 0, mad = 0; // ms a frame, G-buffer included
    double ratio = 1;                    // to sm-uniform in the same interleaved rounds, both with the G-buffer
    double floorRatio = 0;               // share of the frame that the G-buffer alone takes
    std::optional<double> baseRatio;     // to the technique's own base (history over its base map)
    double processorShare = 0;           // of the frame's time, in passes of the processor
    std::vector<double> samples;
};

/// Of the frame in motion (harness/render/motion.h).
struct MotionTime {
    double median = 0; // ms a frame, G-buffer included
    double ratio = 1;  // to sm-uniform in the same rounds
    std::vector<double> samples;
};

/// Of the first frame, ms.
struct ColdTime {
    double frame = 0;   // shaders compiled before
    double compile = 0; // what a new technique takes beyond that
};

/// Whose work it is.
enum class WorkOf { StandingFrame, MovingFrame, FirstFrame };

/// What a technique holds, bytes of textures and buffers.
struct Memory {
    std::uint64_t bytes = 0;
    std::optional<std::uint64_t> peak = {}; // within a frame
};

/// Frames of a level-of-detail technique over the scene's walk, each timed beside lod-switch's, without the G-buffer; of a
/// rasteriser that draws on the calling thread its processor time, which other programs do not disturb.
struct LodTime {
    double median = 0; // ms a frame
    double ratio = 1;  // to lod-switch: median over the frames
    double spread = 0; // median change from one frame to the next, as a share of the former
};

void setWork(Record& record, WorkOf frame, const gl::WorkCount& work);
void setMemory(Record& record, const Memory& memory);
void setTime(Record& record, const Time& time);
void setTime(Record& record, const MotionTime& time);
void setTime(Record& record, const ColdTime& time);
void setTime(Record& record, const LodTime& time);

} // namespace shadowbench
