// How many frames are rendered before one is measured.
#pragma once

namespace shadowbench::timing {

inline constexpr int warmFrames = 2; // the first compiles shaders, the second meets what the first left

} // namespace shadowbench::timing
