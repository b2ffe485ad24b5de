// Seconds that a pass takes on a card, by a model that a reader can check by hand: docs/gpu-cost.md, "Milliseconds on a
// card". Everything that comes out of it is modelled and not measured.
#pragma once

#include "gpu/card.h"

#include <span>
#include <string_view>
#include <vector>

namespace shadowbench::gpu {

/// Vertices, fragments or invocations that run one shader.
struct Shading {
    double count = 0;
    double cycles =
        0; // of a SIMD for 64 lanes that run as a wave of 64: the compiler's inverse throughput or what is executed
    double cycles32 = 0;               // for as many in waves of 32
    double longest = 0, longest32 = 0; // of the longest wave alone; of dispatches and targets one after another, their sum
};

/// Pixels of a colour target that are written, blended or cleared.
struct Written {
    double pixels = 0;
    int bytes = 0;           // of a pixel
    bool fullFloats = false; // channels of 32-bit floats
    bool blends = false;
};

/// What a pass of a frame does.
struct PassWork {
    std::vector<Shading> shading = {};
    double reads = 0; // of textures
    std::vector<Written> output = {};
    double depthPixels = 0;  // written or cleared
    double testedPixels = 0; // of which neither colour nor depth is written: by a stencil, or nothing
    double triangles = 0;
    double bytes = 0;                                            // copied, read back
    double draws = 0, passes = 0, dependents = 0, readBacks = 0; // as of Rate
};

enum class Term { Arithmetic, Texture, Output, Geometry, Memory, Fixed, Program };

/// "arithmetic", …; "the program" where it reads back: the card waits for it, which no term has.
std::string_view name(Term term);

/// Seconds. All but the last at the same time, one after another where they wait: the largest, and `fixed`.
struct Terms {
    double arithmetic = 0, texture = 0, output = 0, geometry = 0, memory = 0, fixed = 0;
    bool waits = false; // for the program

    [[nodiscard]] double seconds() const;
    [[nodiscard]] Term limit() const;
};

Terms termsOf(const PassWork& work, const Card& card);

/// Seconds of all passes, and what they are if one rate of the card is twice what it says (`least`) or half (`most`):
/// whichever rate changes most.
struct FrameTime {
    double seconds = 0, least = 0, most = 0;
};
FrameTime frameTime(std::span<const PassWork> passes, const Card& card);

} // namespace shadowbench::gpu
