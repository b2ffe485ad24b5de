#include "gpu/executed.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace shadowbench::gpu {
namespace {

enum class Kind { Loop, Uniform, Divergent };

/// Blocks first … last of a loop, or those that a jump leaves out.
struct Region {
    Kind kind;
    std::size_t first, last;

    [[nodiscard]] bool has(std::size_t block) const { return first <= block && block <= last; }
};

std::vector<Region> loopsOf(const std::vector<CodeBlock>& blocks) {
    std::map<std::size_t, std::size_t> ends; // by the first block
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks[b].jump != Jump::None && blocks[b].target <= b && b > 0 && blocks[b].target > 0)
            ends[blocks[b].target] = b;
    std::vector<Region> loops;
    for (const auto& [first, last] : ends) loops.push_back({Kind::Loop, first, last});
    return loops;
}

/// The innermost, as its index; none where the block is in no loop. Of two loops the inner one begins later.
std::optional<std::size_t> loopOf(const std::vector<Region>& loops, std::size_t block) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < loops.size(); ++i)
        if (loops[i].has(block)) found = i;
    return found;
}

/// Loops, then sides of conditions. A jump out of a loop is no condition: what follows it goes on in the loop.
std::vector<Region> regionsOf(const std::vector<CodeBlock>& blocks) {
    const std::vector<Region> loops = loopsOf(blocks);
    std::vector<Region> regions = loops;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const CodeBlock& block = blocks[b];
        const bool isCondition = block.jump == Jump::Uniform || block.jump == Jump::Divergent;
        if (!isCondition || block.target <= b + 1 || loopOf(loops, block.target) != loopOf(loops, b)) continue;
        const Kind kind = block.jump == Jump::Uniform ? Kind::Uniform : Kind::Divergent;
        regions.push_back({kind, b + 1, block.target - 1});
        const CodeBlock& end = blocks[block.target - 1]; // jumps over the other side
        if (end.jump == Jump::Always && end.target > block.target && loopOf(loops, end.target) == loopOf(loops, b))
            regions.push_back({kind, block.target, end.target - 1});
    }
    return regions;
}

/// What `waves` waves execute on average.
Busy sumOf(std::span<const Busy> marks, std::span<const std::uint64_t> passes, std::uint64_t waves) {
    Busy sum;
    for (std::size_t k = 0; k < marks.size(); ++k)
        sum.add(marks[k], static_cast<double>(passes[k]) / static_cast<double>(waves));
    return sum;
}

Busy meanOf(std::span<const Busy> marks, std::span<const std::uint64_t> passes) {
    return sumOf(marks, passes, passes.front());
}

} // namespace

double cyclesOf(const Busy& busy, double waves) {
    return std::max({busy[Part::Latency] / waves, busy[Part::Vector], busy[Part::Complex], busy[Part::Scalar]});
}

/// As Mesa's compiler says (ACO, collect_preasm_stats): loops 8 times, 4 times within another, twice further in; a side of a
/// uniform condition half of the times, of a divergent one three quarters.
std::vector<double> guessedWeights(const std::vector<CodeBlock>& blocks) {
    const std::vector<Region> regions = regionsOf(blocks);
    std::vector<double> weights;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        double weight = 1;
        int depth = 0;
        for (const Region& region : regions) {
            if (!region.has(b)) continue;
            if (region.kind == Kind::Loop)
                weight *= depth == 0 ? 8 : depth == 1 ? 4 : 2, ++depth;
            else
                weight *= region.kind == Kind::Uniform ? 0.5 : 0.75;
        }
        weights.push_back(weight);
    }
    return weights;
}

Busy guessedBusy(const std::vector<CodeBlock>& blocks) {
    const std::vector<double> weights = guessedWeights(blocks);
    Busy all;
    for (std::size_t b = 0; b < blocks.size(); ++b) all.add(blocks[b].busy, weights[b]);
    return all;
}

std::size_t loopCount(const std::vector<CodeBlock>& blocks) { return loopsOf(blocks).size(); }

std::vector<Busy> busyOfMarks(const std::vector<CodeBlock>& blocks, unsigned marks) {
    const std::vector<Region> regions = regionsOf(blocks), loops = loopsOf(blocks);
    std::vector<double> places(marks, 0); // an unrolled loop's mark stands in many
    for (const CodeBlock& block : blocks)
        for (const unsigned mark : block.marks) ++places.at(mark);
    const auto markOf = [&](std::size_t b) -> std::optional<unsigned> {
        const auto& own = blocks[b].marks;
        const auto least = std::ranges::min_element(own, {}, [&](unsigned mark) { return places[mark]; });
        return least == own.end() ? std::nullopt : std::optional(*least);
    };
    /// Whether block `b` is in all regions that `other` is in.
    const auto isWithin = [&](std::size_t b, std::size_t other) {
        return std::ranges::all_of(regions, [&](const Region& region) { return region.has(b) || !region.has(other); });
    };
    const auto unmarkedRounds = [&](std::size_t b) {
        double rounds = 1;
        for (const Region& loop : loops) {
            bool hasMark = false;
            for (std::size_t inside = loop.first; inside <= loop.last; ++inside) hasMark |= !blocks[inside].marks.empty();
            if (loop.has(b) && !hasMark) rounds *= rounds == 1 ? 8 : 4;
        }
        return rounds;
    };
    std::vector<Busy> busy(marks);
    const auto add = [&](unsigned mark, const Busy& what) { busy[mark].add(what, 1 / places[mark]); };
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::size_t before = b + 1; // the block of its mark, + 1
        while (before > 0 && !(markOf(before - 1) && isWithin(b, before - 1))) --before;
        if (before == 0) { // runs once: what stands before main's own mark
            busy[0].add(blocks[b].busy, 1);
        } else {
            Busy rounds;
            rounds.add(blocks[b].busy, unmarkedRounds(b));
            add(*markOf(before - 1), rounds);
        }
        const auto loop = loopOf(loops, b);
        if (!loop || unmarkedRounds(b) > 1 || (before > 0 && loops[*loop].has(before - 1))) continue;
        for (std::size_t inside = b; inside <= loops[*loop].last; ++inside)
            if (markOf(inside) && loopOf(loops, inside) == loop) {
                add(*markOf(inside), blocks[b].busy);
                break;
            }
    }
    return busy;
}

Executed executed(const StageFigures& figures, std::span<const Busy> marks, const WavePasses& passes) {
    const auto throughput = static_cast<double>(figures.of("Inverse Throughput"));
    const auto latency = static_cast<double>(figures.of("Latency"));
    const Busy quad = marks.empty() ? figures.guessed : meanOf(marks, passes.quads);
    Executed all{throughput,        throughput, latency, latency, quad[Part::TextureReads], quad[Part::BufferReads],
                 quad[Part::Stores]};
    if (marks.empty()) return all;
    const double cycle = throughput / cyclesOf(figures.guessed, figures.waves);
    all.cycles32 = cycle * cyclesOf(meanOf(marks, passes.waves32), figures.waves);
    all.cycles64 = cycle * cyclesOf(meanOf(marks, passes.waves64), figures.waves);
    const double wait = latency / figures.guessed[Part::Latency];
    all.longest32 = wait * sumOf(marks, passes.longest32, 1)[Part::Latency];
    all.longest64 = wait * sumOf(marks, passes.longest64, 1)[Part::Latency];
    return all;
}

} // namespace shadowbench::gpu
