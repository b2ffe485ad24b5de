// What a history keeps of shadows that have gone, and how long.
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace shadowbench::metrics {
namespace {

constexpr double jump = 0.5;        // of V* from one frame to the next: a shadow came or went
constexpr double rest = 8.0 / 255;  // less than that since: what is left of the old shadow is the technique's
constexpr std::size_t fewest = 32;  // pixels that a share is taken over
constexpr double leastGhost = 0.05; // share; less is how a technique errs at edges
constexpr double unfaded = 0.99;    // of the first share that is left at the end: it does not fade

/// Of a pixel whose V* jumped and has rested since.
struct Past {
    int age = -1;     // frames since; −1: of no such pixel
    float before = 0; // V* before the jump
};

/// How V* changed at a pixel from the frame before.
struct Step {
    bool known = false; // the frame before scores what is seen here
    glm::ivec2 from{0};
    double change = 0;

    /// −1 or 1 where a shadow came or went.
    [[nodiscard]] int direction() const { return std::abs(change) <= jump ? 0 : change > 0 ? 1 : -1; }
};

Image<Step> stepsOf(const FramePair& pair) {
    const auto& [now, before, warp] = pair;
    Image<Step> steps(warp.width(), warp.height());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!now.mask.scored[i] || !isSomewhere(warp[i])) continue;
        const std::optional<glm::ivec2> from = nearestPixel(before, warp[i], now.truth.id[i]);
        if (from) steps[i] = {true, *from, now.truth.visibility[i] - before.truth.visibility(from->x, from->y)};
    }
    return steps;
}

/// Whether the shadow came or went all around, too: labels along an edge jump as the camera moves.
bool jumped(const Image<Step>& steps, int x, int y) {
    const int direction = steps(x, y).direction();
    if (direction == 0) return false;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (!steps.contains(x + dx, y + dy) || steps(x + dx, y + dy).direction() != direction) return false;
    return true;
}

Image<Past> advanced(const Image<Past>& past, const FramePair& pair, const Image<Step>& steps) {
    Image<Past> result(steps.width(), steps.height());
    for (int y = 0; y < steps.height(); ++y)
        for (int x = 0; x < steps.width(); ++x) {
            const Step& step = steps(x, y);
            if (!step.known) continue;
            const Past& then = past(step.from.x, step.from.y);
            if (jumped(steps, x, y))
                result(x, y) = {0, pair.before.truth.visibility(step.from.x, step.from.y)};
            else if (then.age >= 0 && std::abs(step.change) < rest)
                result(x, y) = {then.age + 1, then.before};
        }
    return result;
}

/// The share g of the old shadow for which V* + g (V*before − V*) is nearest to V, over pixels of one age.
struct OldShare {
    double product = 0, square = 0;
    std::size_t count = 0;

    void add(double error, double old) {
        product += error * old;
        square += old * old;
        ++count;
    }
};

/// By age, as far as there are enough pixels.
std::vector<double> oldShares(const MovingFrames& frames) {
    std::vector<OldShare> sums(frames.pairs.size());
    Image<Past> past(frames.pairs.front().warp.width(), frames.pairs.front().warp.height());
    for (const FramePair& pair : frames.pairs) {
        past = advanced(past, pair, stepsOf(pair));
        for (std::size_t i = 0; i < past.size(); ++i) {
            if (past[i].age < 0) continue;
            const double truth = pair.now.truth.visibility[i];
            sums[static_cast<std::size_t>(past[i].age)].add(pair.now.v[i] - truth, past[i].before - truth);
        }
    }
    std::vector<double> shares;
    for (const OldShare& sum : sums) {
        if (sum.count < fewest) break;
        shares.push_back(sum.product / sum.square);
    }
    return shares;
}

/// From `above` the half to `below` it: where an exponential through both is half, or a line if it cannot be one.
double crossing(double above, double below, double half) {
    return below > 0 ? std::log(above / half) / std::log(above / below) : (above - half) / (above - below);
}

} // namespace

std::optional<double> ghostHalfLife(const MovingFrames& frames) {
    if (!frames.remembers || frames.pairs.empty()) return {};
    const std::vector<double> shares = oldShares(frames);
    if (shares.size() < 2 || shares.front() < leastGhost) return {};
    const double half = shares.front() / 2;
    for (std::size_t age = 1; age < shares.size(); ++age)
        if (shares[age] <= half) return static_cast<double>(age - 1) + crossing(shares[age - 1], shares[age], half);
    if (shares.back() > unfaded * shares.front()) return {};
    return static_cast<double>(shares.size() - 1) * std::log(2.0) / std::log(shares.front() / shares.back());
}

} // namespace shadowbench::metrics
