#include "gpu/wave_passes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace shadowbench::gpu {
namespace {

using Counts = std::span<const std::uint32_t>;

void addTo(std::vector<std::uint64_t>& sums, std::span<const std::uint64_t> others) {
    sums.resize(std::max(sums.size(), others.size()), 0);
    for (std::size_t k = 0; k < others.size(); ++k) sums[k] += others[k];
}

/// What waves of one width pass.
class Sums {
public:
    explicit Sums(std::size_t marks) : all(marks, 0), longest(marks, 0), wave_(marks, 0) {}

    void add(Counts lane) {
        for (std::size_t k = 0; k < wave_.size(); ++k) wave_[k] = std::max<std::uint64_t>(wave_[k], lane[k]);
    }
    void endWave() {
        addTo(all, wave_);
        const std::uint64_t length = std::accumulate(wave_.begin(), wave_.end(), std::uint64_t{0});
        if (length > length_) {
            length_ = length;
            longest = wave_;
        }
        std::ranges::fill(wave_, 0);
    }

    std::vector<std::uint64_t> all, longest;

private:
    std::vector<std::uint64_t> wave_; // of its longest lanes
    std::uint64_t length_ = 0;        // of the longest
};

Sums ofTiles(Counts counts, std::size_t marks, std::size_t width, std::size_t height, std::size_t tileWidth,
             std::size_t tileHeight) {
    Sums sums(marks);
    for (std::size_t top = 0; top < height; top += tileHeight)
        for (std::size_t left = 0; left < width; left += tileWidth) {
            for (std::size_t y = top; y < std::min(top + tileHeight, height); ++y)
                for (std::size_t x = left; x < std::min(left + tileWidth, width); ++x)
                    sums.add(counts.subspan((y * width + x) * marks, marks));
            sums.endWave();
        }
    return sums;
}

Sums ofLanes(Counts counts, std::size_t marks, std::size_t group, std::size_t lanes) {
    Sums sums(marks);
    const std::size_t all = counts.size() / marks;
    for (std::size_t first = 0; first < all; first += group)
        for (std::size_t begin = first; begin < std::min(first + group, all); begin += lanes) {
            for (std::size_t lane = begin; lane < std::min({begin + lanes, first + group, all}); ++lane)
                sums.add(counts.subspan(lane * marks, marks));
            sums.endWave();
        }
    return sums;
}

WavePasses passesOf(Sums quads, Sums waves32, Sums waves64) {
    return {std::move(quads.all), std::move(waves32.all), std::move(waves64.all), std::move(waves32.longest),
            std::move(waves64.longest)};
}

} // namespace

void WavePasses::add(const WavePasses& other) {
    addTo(quads, other.quads);
    addTo(waves32, other.waves32);
    addTo(waves64, other.waves64);
    addTo(longest32, other.longest32);
    addTo(longest64, other.longest64);
}

WavePasses passesOfPixels(Counts counts, std::size_t marks, std::size_t width, std::size_t height) {
    return passesOf(ofTiles(counts, marks, width, height, 2, 2), ofTiles(counts, marks, width, height, 8, 4),
                    ofTiles(counts, marks, width, height, 8, 8));
}

WavePasses passesOfGroups(Counts counts, std::size_t marks, std::size_t group) {
    return passesOf(ofLanes(counts, marks, group, 4), ofLanes(counts, marks, group, 32), ofLanes(counts, marks, group, 64));
}

} // namespace shadowbench::gpu
