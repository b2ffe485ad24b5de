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
    /// One draw an instance for the next frame. An instance in transition shows the level that it did not show in the frame
    /// before; when its transition starts, or it was out of view, first the one that is wholly visible, since the older
    /// buffer holds nothing that could fill gaps. Its visibility is τ of eq. 5.1 and its id its own; all others have id 0.
    std::vector<LevelDraw> next(std::span<const LodInstance> instances);

    void reset() { shown_.clear(); }

private:
    struct Shown {
        int pair; // the finer level
        bool coarser;
    };
    std::unordered_map<std::uint32_t, Shown> shown_; // of the frame before, by id
};

} // namespace shadowbench::techniques
