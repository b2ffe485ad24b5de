#include "techniques/shared/sampling/sampling.h"

#include "base/random.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace shadowbench::techniques {

double halton(std::uint32_t index, std::uint32_t base) {
    double result = 0;
    double digit = 1;
    for (; index > 0; index /= base) {
        digit /= base;
        result += digit * (index % base);
    }
    return result;
}

double haltonOf(int frame, std::uint32_t seed, std::uint32_t base) {
    const double turn = seed == 1 ? 0 : hashed(mixBits(seed) + base);
    return glm::fract(halton(1 + static_cast<std::uint32_t>(frame), base) + turn);
}

namespace {

/// Distance to the region's rim; negative outside.
float inset(const glm::vec2& point, Region region) {
    if (region == Region::Disk) return 1 - glm::length(point);
    return 1 - glm::max(glm::abs(point.x), glm::abs(point.y));
}

} // namespace

std::vector<glm::vec2> poissonTaps(int count, Region region) {
    constexpr int candidates = 512;
    std::vector<glm::vec2> points{{0, 0}};
    std::uint32_t index = 0;
    while (points.size() < static_cast<std::size_t>(count)) {
        glm::vec2 best(0);
        float bestDistance = -1;
        for (int tried = 0; tried < candidates; ++index) {
            const glm::vec2 candidate(2 * halton(index, 2) - 1, 2 * halton(index, 3) - 1);
            const float rim = inset(candidate, region);
            if (rim < 0) continue;
            ++tried;
            float distance = 2 * rim; // a point speaks for a disk around it, which should stay inside
            for (const glm::vec2& point : points) distance = glm::min(distance, glm::distance(point, candidate));
            if (distance > bestDistance) {
                best = candidate;
                bestDistance = distance;
            }
        }
        points.push_back(best);
    }
    return points;
}

std::vector<glm::vec2> gridTaps(int side) {
    const auto centre = [&](int i) { return static_cast<float>(2 * i + 1) / static_cast<float>(side) - 1; };
    std::vector<glm::vec2> taps;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) taps.emplace_back(centre(x), centre(y));
    return taps;
}

const std::vector<glm::vec2>& keptPoissonTaps(int count, Region region) {
    thread_local std::map<std::pair<int, Region>, std::vector<glm::vec2>> kept;
    std::vector<glm::vec2>& taps = kept[{count, region}];
    if (taps.empty()) taps = poissonTaps(count, region);
    return taps;
}

std::vector<glm::vec2> gaussianPairs(int count, double sigma) {
    const auto gaussian = [&](double x) { return std::exp(-0.5 * x * x / (sigma * sigma)); };
    double sum = gaussian(0);
    for (int x = 1; x <= count; ++x) sum += 2 * gaussian(x);
    std::vector<glm::vec2> pairs;
    for (int x = 1; x <= count; ++x) pairs.emplace_back(x, gaussian(x) / sum);
    return pairs;
}

} // namespace shadowbench::techniques
