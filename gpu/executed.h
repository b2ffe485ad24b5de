// What a shader executes: its machine code, weighed by how often waves pass the marks of its text (gpu/marks.h).
#pragma once

#include "gpu/figures.h"
#include "gpu/machine_code.h"
#include "gpu/wave_passes.h"

#include <span>
#include <vector>

namespace shadowbench::gpu {

/// The cycles of a wave where `waves` run beside each other: by the unit that is busiest.
double cyclesOf(const Busy& busy, double waves);

/// How often the compiler guesses that a wave runs each block.
std::vector<double> guessedWeights(const std::vector<CodeBlock>& blocks);
Busy guessedBusy(const std::vector<CodeBlock>& blocks);

/// How many loops are left in it.
std::size_t loopCount(const std::vector<CodeBlock>& blocks);

/// What each of `marks` marks executes. A block that has none is of the nearest before it that is passed wherever it is;
/// what stands in a loop before its first mark, which is its test, once more than that; a loop without any mark runs as
/// often as the compiler guesses.
std::vector<Busy> busyOfMarks(const std::vector<CodeBlock>& blocks, unsigned marks);

/// Of one fragment or compute shader, the mean of its waves.
struct Executed {
    double cycles32 = 0, cycles64 = 0;   // for each 64 lanes, in waves of 32 and of 64
    double longest32 = 0, longest64 = 0; // of the longest wave while none runs beside it, of all targets and dispatches
    double textureReads = 0, bufferReads = 0, stores = 0; // of a lane, where the longest of each four decides
};

/// `figures` are of the code without marks. The compiler's inverse throughput is scaled by what is executed over what the
/// compiler guesses; without marks it is the figure.
Executed executed(const StageFigures& figures, std::span<const Busy> marks, const WavePasses& passes);

} // namespace shadowbench::gpu
