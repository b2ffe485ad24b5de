// Which of its two levels an instance in transition shows in which frame: the toggle of dissertation 5.2.1. No GL.
#pragma once

#include "techniques/lod/level_drawer.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace shadowbench::techniques {

class Alternation {
public:
    /// Ids run from 1 to here: what eight bits hold beside 0.
    static constexpr std::uint32_t ids = 255;

    /// One draw an instance for the next frame. An instance in transition shows its coarser level in every second frame,
    /// those with even numbers while those with odd ones show the finer level, so that as many triangles are drawn in one
    /// frame as in the next. In the frame in which its transition starts, or it comes into view, it shows the level that is
    /// wholly visible, since the older buffer holds nothing that could fill gaps; but not in the first frame of all, which
    /// fills both buffers. Its visibility is τ of eq. 5.1. Its id is its own in this frame and the one before, as long as
    /// no more than `ids` instances are in transition in the two; then some share theirs. All others have id 0.
    std::vector<LevelDraw> next(std::span<const LodInstance> instances);

    void reset() { *this = {}; }

private:
    struct Shown {
        int pair; // the finer level
        std::uint32_t id;
    };
    std::unordered_map<std::uint32_t, Shown> shown_; // in the frame before, by the instance's number
    std::uint32_t frame_ = 0;
};

} // namespace shadowbench::techniques
