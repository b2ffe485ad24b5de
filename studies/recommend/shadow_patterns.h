// Hard shadows of many casters, each known alone: the shadow of several is the union of theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace shadowbench::recommend {

/// Labels against exact ones, in pixels.
struct LabelErrors {
    std::size_t lit = 0, shadowed = 0;     // by the exact labels
    std::size_t falseShadow = 0, leak = 0; // of these: wrong

    void add(bool shadow, bool exact, std::size_t pixels = 1);
};

/// A set of at most 64 casters, one bit each.
using CasterSet = std::uint64_t;
constexpr std::size_t mostCasters = 64;

/// How many pixels each set of casters shadows.
class ShadowPatterns {
public:
    /// For every pixel, the casters whose shadow it lies in.
    explicit ShadowPatterns(std::vector<CasterSet> pixels);

    /// The shadow of `casters` together against that of `exact`. A pixel lies in it if it lies in one of theirs.
    [[nodiscard]] LabelErrors compare(CasterSet casters, CasterSet exact) const;

private:
    std::vector<std::pair<CasterSet, std::size_t>> counts_; // pixels by set
};

} // namespace shadowbench::recommend
