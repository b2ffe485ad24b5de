#include "harness/foreign/shadow_edges.h"

#include "harness/metrics/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace shadowbench::foreign {
namespace {

using groundtruth::Reference;
using metrics::ScoredFrame;

constexpr int squares = 8; // of the image, along each side

std::size_t squareOf(const ScoredFrame& frame, glm::ivec2 pixel) {
    return static_cast<std::size_t>(pixel.y * squares / frame.v.height() * squares + pixel.x * squares / frame.v.width());
}

/// Positive where lit; infinite on surfaces without an edge.
Image<float> signedDistances(const Reference& truth) {
    Image<float> distances = truth.edgeDistance;
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (!metrics::isLit(truth.visibility[i])) distances[i] = -distances[i];
    return distances;
}

/// What differences are worth as evidence.
struct Weights {
    double farthest; // what differs by more is no displaced edge
    double smallest; // no difference is known better
    double alike;    // neighbours err alike, so that many count once
};

/// Of the edges that one explanation moves towards the light, and towards the shadow.
struct SidesEvidence {
    double towardsLight = 0, towardsShadow = 0;
    double squares = 0; // the sum of the squares of what they are sums of
    [[nodiscard]] double sum() const { return towardsLight + towardsShadow; }
};

/// Differences from the truth under two explanations, in each square, apart by the side that the one moves edges to. A mean
/// of absolute differences is the likeliest width of a Laplace distribution.
class Comparison {
public:
    explicit Comparison(const Weights& weights) : weights_(weights) {
        for (std::vector<Sums>& side : sums_) side.resize(squares * squares);
    }

    void add(std::size_t square, bool towardsLight, double with, double without) {
        Sums& sums = sums_[towardsLight ? 0 : 1][square];
        sums.with += std::min(std::abs(with), weights_.farthest);
        sums.without += std::min(std::abs(without), weights_.farthest);
        ++sums.count;
    }

    [[nodiscard]] SidesEvidence evidence() const {
        SidesEvidence found;
        found.towardsLight = total(sums_[0], found.squares);
        found.towardsShadow = total(sums_[1], found.squares);
        return found;
    }

private:
    struct Sums {
        double with = 0, without = 0;
        int count = 0;
    };

    [[nodiscard]] double total(const std::vector<Sums>& all, double& sumOfSquares) const {
        constexpr double most = 4; // of what counts once, in one square
        double sum = 0;
        for (const Sums& one : all) {
            if (one.count < weights_.alike / 2) continue;
            const double ratio = (one.without / one.count + weights_.smallest) / (one.with / one.count + weights_.smallest);
            const double evidence = std::min(one.count / weights_.alike, most) * std::log(ratio);
            sum += evidence;
            sumOfSquares += evidence * evidence;
        }
        return sum;
    }

    Weights weights_;
    std::array<std::vector<Sums>, 2> sums_;
};

/// Of labels: points of the image's shadow edges, and how far they would be from the exact ones if the image were moved.
class EdgePoints {
public:
    explicit EdgePoints(const ScoredFrame& frame) : frame_(frame), distances_(signedDistances(frame.truth)) {
        for (const metrics::Crossing& pair : metrics::crossings(frame.v, frame.truth, frame.mask))
            points_.push_back({metrics::between(pair, metrics::halfCrossing(frame.v, pair)),
                               frame.truth.id(pair.a.x, pair.a.y), squareOf(frame, pair.a)});
    }

    /// For a shift by `shift` against one by `other`.
    [[nodiscard]] SidesEvidence evidence(glm::dvec2 shift, glm::dvec2 other) const {
        constexpr double least = 0.25;      // of the difference, along an edge's normal: other edges say nothing
        Comparison comparison({4, 0.1, 8}); // pixels
        for (const Point& point : points_) {
            const auto with = distance(point, shift), without = distance(point, other);
            if (!with || !without) continue;
            const double moved = *without - *with;
            if (std::abs(moved) >= least * glm::distance(shift, other))
                comparison.add(point.square, moved > 0, *with, *without);
        }
        return comparison.evidence();
    }

private:
    struct Point {
        glm::dvec2 at;
        std::uint32_t id;
        std::size_t square;
    };

    [[nodiscard]] std::optional<double> distance(const Point& point, glm::dvec2 shift) const {
        const metrics::Bilinear at(point.at - shift);
        if (!at.within(frame_.mask, frame_.truth.id, point.id)) return std::nullopt;
        const double found = at(distances_);
        return std::isfinite(found) ? std::optional(found) : std::nullopt;
    }

    const ScoredFrame& frame_;
    Image<float> distances_;
    std::vector<Point> points_;
};

/// Of graded truths: the pixels of penumbrae, and what the image would show there if it were moved.
class PenumbraPixels {
public:
    explicit PenumbraPixels(const ScoredFrame& frame) : frame_(frame) {
        for (int y = 0; y < frame.v.height(); ++y)
            for (int x = 0; x < frame.v.width(); ++x) {
                const float truth = frame.truth.visibility(x, y);
                if (frame.mask.scored(x, y) != 0 && truth > 0 && truth < 1) pixels_.push_back({x, y});
            }
    }

    [[nodiscard]] SidesEvidence evidence(glm::dvec2 shift, glm::dvec2 other) const {
        constexpr double least = 0.004; // of visibility, over the difference: elsewhere a shift changes nothing
        Comparison comparison({0.25, 0.01, 32});
        for (const glm::ivec2 pixel : pixels_) {
            const auto with = shown(frame_.v, pixel, shift), without = shown(frame_.v, pixel, other);
            const auto there = shown(frame_.truth.visibility, pixel, other - shift);
            if (!with || !without || !there) continue;
            const double truth = static_cast<double>(frame_.truth.visibility(pixel.x, pixel.y));
            if (std::abs(*there - truth) >= least)
                comparison.add(squareOf(frame_, pixel), *there < truth, *with - truth, *without - truth);
        }
        return comparison.evidence();
    }

private:
    [[nodiscard]] std::optional<double> shown(const Image<float>& image, glm::ivec2 pixel, glm::dvec2 by) const {
        const metrics::Bilinear at(glm::dvec2(pixel) + 0.5 + by);
        if (!at.within(frame_.mask, frame_.truth.id, frame_.truth.id(pixel.x, pixel.y))) return std::nullopt;
        return at(image);
    }

    const ScoredFrame& frame_;
    std::vector<glm::ivec2> pixels_;
};

template <class Points>
ShiftEvidence likeliestShift(const Points& points) {
    constexpr int farthest = 2;
    ShiftEvidence found;
    double most = 0;
    for (int y = -farthest; y <= farthest; ++y)
        for (int x = -farthest; x <= farthest; ++x) {
            const SidesEvidence sides = points.evidence({x, y}, {0, 0});
            if (sides.sum() <= most) continue;
            most = sides.sum();
            found = {.by = {x, y},
                     .towardsLight = sides.towardsLight,
                     .towardsShadow = sides.towardsShadow,
                     .agreement = most / std::sqrt(sides.squares)};
        }
    if (found.by == glm::ivec2(0, 0)) return found;
    const glm::dvec2 shift(found.by);
    found.overHalf = points.evidence(shift, 0.5 * shift).sum();
    found.overMore = points.evidence(shift, 1.5 * shift).sum();
    return found;
}

} // namespace

ShiftEvidence shiftEvidence(const ScoredFrame& frame, bool labels) {
    return labels ? likeliestShift(EdgePoints(frame)) : likeliestShift(PenumbraPixels(frame));
}

bool isSuspect(const ShiftEvidence& evidence) {
    constexpr double enough = 6; // e⁶ times as likely, from both kinds of edges
    constexpr double each = 1.5;
    constexpr double spread = 1; // beyond what squares that disagree by chance add up to
    constexpr double doubt = -1; // as good as no worse than another distance
    return evidence.towardsLight + evidence.towardsShadow >= enough && evidence.agreement >= spread &&
           std::min(evidence.towardsLight, evidence.towardsShadow) >= each &&
           std::min(evidence.overHalf, evidence.overMore) >= doubt;
}

bool isSure(const ShiftEvidence& evidence) {
    constexpr double spread = 2.5;
    return isSuspect(evidence) && evidence.agreement >= spread;
}

} // namespace shadowbench::foreign
