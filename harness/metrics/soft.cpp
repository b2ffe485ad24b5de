// Scores of graded visibility.
#include "harness/metrics/pixels.h"
#include "harness/metrics/thresholds.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shadowbench::metrics {
namespace {

struct Errors {
    double squares = 0, absolutes = 0;
};

Errors errors(const ScoredFrame& frame, const Image<std::uint8_t>& pixels) {
    const auto& [v, truth, mask] = frame;
    Errors sum;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (!pixels[i]) continue;
        const double difference = static_cast<double>(v[i]) - truth.visibility[i];
        sum.squares += difference * difference;
        sum.absolutes += std::abs(difference);
    }
    return sum;
}

std::size_t count(const Image<std::uint8_t>& pixels) {
    std::size_t sum = 0;
    for (const std::uint8_t pixel : pixels) sum += pixel;
    return sum;
}

/// Absent where there is no pixel.
std::optional<double> rmseOver(const ScoredFrame& frame, const Image<std::uint8_t>& pixels) {
    const std::size_t n = count(pixels);
    if (n == 0) return {};
    return std::sqrt(errors(frame, pixels).squares / static_cast<double>(n));
}

template <typename Predicate>
Image<std::uint8_t> select(const groundtruth::Reference& truth, const Mask& mask, const Predicate& wanted) {
    Image<std::uint8_t> result(mask.scored.width(), mask.scored.height());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = mask.scored[i] && wanted(truth.visibility[i]) ? 1 : 0;
    return result;
}

/// Calls `visit` with each pixel of the (2r+1)² square around (x, y), inside the image or not.
template <typename Visit>
void forNeighbours(int x, int y, int r, const Visit& visit) {
    for (int dy = -r; dy <= r; ++dy)
        for (int dx = -r; dx <= r; ++dx) visit(x + dx, y + dy);
}

Image<std::uint8_t> dilated(const Image<std::uint8_t>& set, int r, const Mask& within) {
    Image<std::uint8_t> result(set.width(), set.height());
    for (int y = 0; y < set.height(); ++y) {
        for (int x = 0; x < set.width(); ++x) {
            if (!set(x, y)) continue;
            forNeighbours(x, y, r, [&](int nx, int ny) {
                if (result.contains(nx, ny) && within.scored(nx, ny)) result(nx, ny) = 1;
            });
        }
    }
    return result;
}

Image<std::uint8_t> eroded(const Image<std::uint8_t>& set, int r) {
    Image<std::uint8_t> result = set;
    for (int y = 0; y < set.height(); ++y) {
        for (int x = 0; x < set.width(); ++x) {
            forNeighbours(x, y, r, [&](int nx, int ny) {
                if (!set.contains(nx, ny) || !set(nx, ny)) result(x, y) = 0;
            });
        }
    }
    return result;
}

/// Share of M where abs(V − V*) exceeds `threshold`.
std::optional<double> shareAbove(const ScoredFrame& frame, double threshold) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    if (mask.count == 0) return {};
    std::size_t above = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (mask.scored[i] && std::abs(static_cast<double>(v[i]) - truth.visibility[i]) > threshold) ++above;
    return static_cast<double>(above) / static_cast<double>(mask.count);
}

Image<std::uint8_t> penumbraOf(const ScoredFrame& frame) {
    return select(frame.truth, frame.mask, [](float exact) { return exact > 0 && exact < 1; });
}

/// Dark pixels away from any that is not.
Image<std::uint8_t> umbraOf(const ScoredFrame& frame, const Thresholds& near = {}) {
    return eroded(select(frame.truth, frame.mask, [](float exact) { return exact == 0; }), near.neighbourhood);
}

/// The grey of a picture in which 0.3 of full light is ambient.
long grey(double visibility) { return std::lround(255 * (0.3 + 0.7 * visibility)); }

} // namespace

std::optional<VisibilityErrors> visibilityErrors(const ScoredFrame& frame) {
    requireComparable(frame);
    const double n = static_cast<double>(frame.mask.count);
    if (n == 0) return {};
    const Errors sum = errors(frame, frame.mask.scored);
    VisibilityErrors result{std::sqrt(sum.squares / n), sum.absolutes / n, {}};
    if (result.rmse > 0) result.psnr = -20 * std::log10(result.rmse); // peak 1
    return result;
}

std::optional<double> rmse(const ScoredFrame& frame) {
    const std::optional<VisibilityErrors> errors = visibilityErrors(frame);
    return errors ? std::optional(errors->rmse) : std::nullopt;
}

std::optional<double> bad30(const ScoredFrame& frame) { return shareAbove(frame, 30.0 / 255.0); }
std::optional<double> bad8(const ScoredFrame& frame) { return shareAbove(frame, 8.0 / 255.0); }

PenumbraErrors penumbraErrors(const ScoredFrame& frame) { return penumbraErrorsBy({}, frame); }

PenumbraErrors penumbraErrorsBy(const Thresholds& near, const ScoredFrame& frame) {
    requireComparable(frame);
    const Image<std::uint8_t> penumbra = penumbraOf(frame);
    return {rmseOver(frame, penumbra), rmseOver(frame, dilated(penumbra, near.neighbourhood, frame.mask))};
}

std::optional<double> umbraLeak(const ScoredFrame& frame) { return umbraLeakBy({}, frame); }

std::optional<double> umbraLeakBy(const Thresholds& near, const ScoredFrame& frame) {
    requireComparable(frame);
    const Image<std::uint8_t> pixels = umbraOf(frame, near);
    const std::size_t n = count(pixels);
    if (n == 0) return {};
    double sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (pixels[i]) sum += frame.v[i];
    return sum / static_cast<double>(n);
}

GradedPixels gradedPixels(const ScoredFrame& frame) {
    requireComparable(frame);
    return {static_cast<double>(frame.mask.count), static_cast<double>(count(penumbraOf(frame))),
            static_cast<double>(count(umbraOf(frame)))};
}

std::optional<Umbra> umbra(const ScoredFrame& frame) {
    requireComparable(frame);
    constexpr float firstGrey = 0.5F / 255; // from here on a byte would hold 1
    std::size_t drawn = 0, exact = 0, penumbra = 0;
    for (std::size_t i = 0; i < frame.v.size(); ++i) {
        if (!frame.mask.scored[i]) continue;
        const float truth = frame.truth.visibility[i];
        if (frame.v[i] < firstGrey) ++drawn;
        if (truth < firstGrey) ++exact;
        if (truth > 0 && truth < 1) ++penumbra;
    }
    if (penumbra == 0) return {};
    const auto all = static_cast<double>(frame.mask.count);
    return Umbra{static_cast<double>(drawn) / all, static_cast<double>(exact) / all};
}

namespace {

/// The values of the side × side pixels from (x, y) on, in order of size, if all are graded, in M and of one surface; else
/// nothing.
std::vector<float> gradedSquare(const ScoredFrame& frame, int x, int y, int side) {
    std::vector<float> values;
    for (int dy = 0; dy < side; ++dy)
        for (int dx = 0; dx < side; ++dx) {
            const bool counts = frame.v.contains(x + dx, y + dy) && frame.mask.scored(x + dx, y + dy) &&
                                frame.truth.id(x + dx, y + dy) == frame.truth.id(x, y);
            const float v = counts ? frame.v(x + dx, y + dy) : 0;
            if (!(v > 0.02F && v < 0.98F)) return {};
            values.push_back(v);
        }
    std::ranges::sort(values);
    return values;
}

} // namespace

Grain grain(const ScoredFrame& frame) {
    requireComparable(frame);
    double plateaus = 0, squares = 0, distance = 0, medians = 0;
    for (int y = 0; y < frame.v.height(); ++y)
        for (int x = 0; x < frame.v.width(); ++x) {
            if (const std::vector<float> four = gradedSquare(frame, x, y, 2); !four.empty()) {
                ++squares;
                if (four.back() - four.front() <= 1.0F / 255) ++plateaus;
            }
            if (const std::vector<float> nine = gradedSquare(frame, x, y, 3); !nine.empty()) {
                ++medians;
                distance += std::abs(static_cast<double>(frame.v(x + 1, y + 1)) - static_cast<double>(nine[4]));
            }
        }
    Grain result;
    if (squares > 0) result.plateau = plateaus / squares;
    if (medians > 0) result.noise = distance / medians;
    return result;
}

std::optional<double> unresolved(const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    std::size_t uncertain = 0, within = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double sigma = truth.sigma[i];
        if (!mask.scored[i] || !(sigma > 0)) continue;
        ++uncertain;
        if (std::abs(static_cast<double>(v[i]) - truth.visibility[i]) < 3 * sigma) ++within;
    }
    if (uncertain == 0) return {};
    return static_cast<double>(within) / static_cast<double>(mask.count);
}

std::optional<PictureCorrectness> pictureCorrectness(const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    if (count(penumbraOf(frame)) == 0) return {};
    std::vector<long> differences;
    for (std::size_t i = 0; i < v.size(); ++i)
        differences.push_back(mask.scored[i] ? std::abs(grey(v[i]) - grey(truth.visibility[i])) : 0);
    const auto shareWithin = [&](long steps) {
        const auto within = std::ranges::count_if(differences, [&](long difference) { return difference <= steps; });
        return static_cast<double>(within) / static_cast<double>(differences.size());
    };
    return PictureCorrectness{shareWithin(2), shareWithin(8), shareWithin(16), shareWithin(30)};
}

} // namespace shadowbench::metrics
