// The machine code of one shader as AMD's compiler prints it, block by block, and what each block keeps busy.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gpu {

/// What a wave of 64 lanes keeps busy, in cycles, and what it asks of memory.
enum class Part {
    Latency, // of a wave that runs alone
    Vector,  // of the SIMD
    Complex, // of its slow unit: transcendental functions, products of 32-bit integers, doubles
    Scalar,
    TextureReads, // instructions
    BufferReads,
    Stores // and atomics
};
inline constexpr std::size_t partCount = 7;

struct Busy {
    std::array<double, partCount> parts{};

    [[nodiscard]] double operator[](Part part) const { return parts.at(static_cast<std::size_t>(part)); }
    double& operator[](Part part) { return parts.at(static_cast<std::size_t>(part)); }
    void add(const Busy& other, double times);
};

enum class Jump { None, Always, Uniform, Divergent }; // Divergent: only where no lane is left

/// What runs from its first to its last instruction.
struct CodeBlock {
    Busy busy;
    std::vector<unsigned> marks = {}; // that stand in it (gpu/marks.h), one for each time
    Jump jump = Jump::None;
    std::size_t target = 0; // index of the block that is jumped to
};

/// In the order of addresses, each falling through into the next unless it always jumps. The stores of marks are in `marks`
/// and in no figure. Throws BadInput for text that is no such code.
std::vector<CodeBlock> codeBlocks(const std::string& assembly);

} // namespace shadowbench::gpu
