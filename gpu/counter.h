// How often waves take each loop and branch of the shaders of a frame, counted while llvmpipe draws it: all shaders that are
// compiled while a counter lives carry marks (gpu/marks.h).
#pragma once

#include "gpu/wave_passes.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace shadowbench::gpu {

/// One at a time, of the context that is current and outlives it; made before what it counts is compiled. Programs that it
/// has marked draw the same bits with it and after it; the memory that they write is its own while it lives.
class Counter {
public:
    Counter();
    ~Counter();
    Counter(const Counter&) = delete;
    Counter& operator=(const Counter&) = delete;

    /// Called before a draw or a dispatch by the program in use, which counts for `key`. Of draws into one target that
    /// follow each other, fragments of one pixel add up.
    void draw(const std::string& key);
    void dispatch(const std::string& key, std::array<unsigned, 3> groups, unsigned invocationsOfGroup);

    /// By key, since the last call. Shaders without a loop or branch have none.
    std::map<std::string, WavePasses> take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shadowbench::gpu
