#include "harness/foreign/encodings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace shadowbench::foreign {
namespace {

// Fractions.

constexpr int mostSamples = 256;
constexpr double same = 1e-6;             // rounding of 32-bit floats on the way
constexpr float nearlyWhole = 1.0F / 255; // nearer to 0 and 1 codes are dense, and clamping makes values alike

/// Values that at least two pixels show, sorted, between black and white.
std::vector<double> sharedValues(std::vector<float> values) {
    std::erase_if(values, [](float v) { return !(v > nearlyWhole && v < 1 - nearlyWhole); });
    std::ranges::sort(values);
    std::vector<double> shared;
    for (std::size_t first = 0; first < values.size();) {
        std::size_t end = first + 1;
        while (end < values.size() && static_cast<double>(values[end] - values[end - 1]) <= same) ++end;
        if (end - first > 1) shared.push_back(static_cast<double>(values[first]));
        first = end;
    }
    return shared;
}

/// Half the distance of the values that the file could hold: of integers, 16-bit or 32-bit floats. All integers are
/// fractions of the largest, which says nothing of samples.
double resolution(const std::vector<double>& shared) {
    for (const double largest : {255.0, 1023.0}) {
        if (std::ranges::all_of(shared, [=](double v) { return std::abs(v - std::round(v * largest) / largest) < same; }))
            return 0.505 / largest;
    }
    const auto isHalf = [](double v) { // 11 bits from the first one on
        const double step = std::ldexp(1.0, std::ilogb(v) - 10);
        return std::abs(v - std::round(v / step) * step) < same;
    };
    constexpr double half = 2.5e-4, full = 8e-6; // near 1; 16-bit integers, too
    return std::ranges::all_of(shared, isHalf) ? half : full;
}

/// How many of the codes of k/n have a shared value within `step`.
int levelsFound(const std::vector<double>& shared, const std::vector<double>& codes, double step) {
    return static_cast<int>(std::ranges::count_if(codes, [&](double code) {
        const auto at = std::ranges::lower_bound(shared, code - step);
        return at != shared.end() && *at <= code + step;
    }));
}

double logarithmOfChoices(std::size_t all, int chosen) {
    const auto n = static_cast<double>(all), k = static_cast<double>(chosen);
    return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

// Grey pixels.

constexpr float darkest = 0.02F, brightest = 0.98F;
constexpr float farthest = 3; // pixels from an exact edge: what is grey farther off says more of the technique

/// Sums over values that the likeliest symmetric beta distribution needs.
class SymmetricDistribution {
public:
    void add(double value) {
        const double v = std::clamp(value, 1e-4, 1 - 1e-4);
        logarithms_ += std::log(v) + std::log1p(-v);
        ++count_;
    }
    [[nodiscard]] double logarithmOfLikelihood() const {
        double best = -std::numeric_limits<double>::infinity();
        for (const double shape : {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0}) // from nearly hard over even to soft
            best = std::max(best, (shape - 1) * logarithms_ - count_ * (2 * std::lgamma(shape) - std::lgamma(2 * shape)));
        return best;
    }

private:
    double logarithms_ = 0;
    int count_ = 0;
};

/// d undo / dv.
double slope(float (*undo)(float), float v) {
    constexpr float step = 1e-3F;
    return static_cast<double>(undo(v + step) - undo(v - step)) / (2 * static_cast<double>(step));
}

} // namespace

EncodedFractions encodedFractions(std::vector<float> stored, float (*code)(float)) {
    const std::vector<double> shared = sharedValues(std::move(stored));
    if (shared.empty()) return {};
    const double step = resolution(shared);
    EncodedFractions found;
    double least = 0; // logarithm of the chance
    for (int n = 2; n <= mostSamples; ++n) {
        const double covered = 2 * step * (n - 1); // by codes, of all values
        if (covered >= 1) break;
        std::vector<double> codes;
        for (int k = 1; k < n; ++k)
            codes.push_back(static_cast<double>(code(static_cast<float>(k) / static_cast<float>(n))));
        const int levels = std::min(levelsFound(shared, codes, step), static_cast<int>(shared.size()));
        if (levels == 0) continue;
        const double chance = std::log(mostSamples) + logarithmOfChoices(shared.size(), levels) + levels * std::log(covered);
        if (chance >= least) continue;
        least = chance;
        found = {n, levels, std::exp(chance)};
    }
    return found;
}

bool isSure(const EncodedFractions& encoded, const EncodedFractions& asTheyStand) {
    constexpr double rare = 1e-6; // false alarms among images whose values have nothing to do with an encoding
    return encoded.chance < rare && encoded.chance < asTheyStand.chance;
}

GreyPixels greyPixels(const metrics::ScoredFrame& frame, float (*undo)(float)) {
    SymmetricDistribution was, is;
    GreyPixels grey;
    for (std::size_t i = 0; i < frame.v.size(); ++i) {
        const float v = frame.v[i], label = frame.truth.visibility[i];
        if (frame.mask.scored[i] == 0 || v < darkest || v > brightest || !(frame.truth.edgeDistance[i] <= farthest))
            continue;
        ++grey.count;
        was.add(static_cast<double>(v));
        is.add(static_cast<double>(undo(v)));
        grey.evener += std::log(slope(undo, v));
        grey.before += static_cast<double>(v - label);
        grey.after += static_cast<double>(undo(v) - label);
    }
    if (grey.count == 0) return grey;
    grey.evener += is.logarithmOfLikelihood() - was.logarithmOfLikelihood();
    grey.before /= grey.count;
    grey.after /= grey.count;
    return grey;
}

bool isSuspect(const GreyPixels& grey) {
    constexpr int enough = 24;
    if (grey.count < enough || grey.evener <= 0) return false;
    const double chance = 0.29 / std::sqrt(static_cast<double>(grey.count)); // of an even ramp's values
    if (std::abs(grey.before) - std::abs(grey.after) > 3 * chance) return true;
    // The mean may err as a technique's edges do. Of an edge that lies right the two add up to 0.19 if it is encoded, and to
    // -0.19 if not: where values leave no doubt, what is nearer to not encoded than half of that contradicts them.
    constexpr double noDoubt = 12; // e³ times as likely, were four neighbours alike
    const double sign = grey.before > grey.after ? 1 : -1;
    return grey.evener > noDoubt && sign * (grey.before + grey.after) > -0.1;
}

} // namespace shadowbench::foreign
