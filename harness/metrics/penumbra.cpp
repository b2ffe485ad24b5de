// Width of penumbrae; the estimator is described at penumbraWidthError() in table.h.
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::metrics {
namespace {

constexpr double step = 0.25;     // pixels
constexpr double leastMargin = 4; // pixels of line beyond the truth's penumbra
constexpr double low = 0.1, high = 0.9;

/// A line across an edge on one surface.
struct Line {
    glm::dvec2 origin, direction; // direction of unit length
    std::uint32_t id;
    [[nodiscard]] glm::dvec2 at(int i) const { return origin + i * step * direction; }
};

struct Scored {
    const groundtruth::Reference& truth;
    const Mask& mask;
    [[nodiscard]] bool has(const Line& line, int i) const { return Bilinear(line.at(i)).within(mask, truth.id, line.id); }
};

std::optional<Line> lineAcross(const Crossing& pair, const Scored& scored) {
    const Image<float>& exact = scored.truth.visibility;
    const glm::dvec2 p = between(pair, halfCrossing(exact, pair));
    const std::uint32_t id = scored.truth.id(pair.a.x, pair.a.y);
    glm::dvec2 gradient(0);
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 offset(0);
        offset[axis] = 1;
        const Bilinear after(p + offset);
        const Bilinear before(p - offset);
        if (!after.within(scored.mask, scored.truth.id, id) || !before.within(scored.mask, scored.truth.id, id)) return {};
        gradient[axis] = after(exact) - before(exact);
    }
    if (glm::length(gradient) == 0) return {};
    return Line{p, glm::normalize(gradient), id};
}

/// Steps from the origin until V* leaves (low, high) in the direction of `sign`; nothing if the line leaves M first.
std::optional<int> stepsOut(const Line& line, const Scored& scored, int sign) {
    for (int i = 0;; ++i) {
        if (!scored.has(line, sign * i)) return {};
        const double exact = Bilinear(line.at(sign * i))(scored.truth.visibility);
        if (exact <= low || exact >= high) return i;
    }
}

/// The last step, up to `wanted`, to which the line stays in M.
int stepsInside(const Line& line, const Scored& scored, int sign, int from, int wanted) {
    int i = from;
    while (i < wanted && scored.has(line, sign * (i + 1))) ++i;
    return i;
}

/// The share of a step, on which the value runs linearly from a to b, where it lies between low and high.
double shareBetween(double a, double b) {
    if (a == b) return a > low && a < high ? 1 : 0;
    const double t0 = std::clamp((low - a) / (b - a), 0.0, 1.0);
    const double t1 = std::clamp((high - a) / (b - a), 0.0, 1.0);
    return std::abs(t1 - t0);
}

double width(const Image<float>& image, const Line& line, int first, int last) {
    double length = 0;
    double before = Bilinear(line.at(first))(image);
    for (int i = first + 1; i <= last; ++i) {
        const double here = Bilinear(line.at(i))(image);
        length += step * shareBetween(before, here);
        before = here;
    }
    return length;
}

std::optional<double> widthErrorAt(const Crossing& pair, const Image<float>& v, const Scored& scored) {
    const std::optional<Line> line = lineAcross(pair, scored);
    if (!line) return {};
    const std::optional<int> back = stepsOut(*line, scored, -1);
    const std::optional<int> ahead = stepsOut(*line, scored, +1);
    if (!back || !ahead) return {};
    const int margin = std::max(*back + *ahead, static_cast<int>(leastMargin / step));
    const int first = -stepsInside(*line, scored, -1, *back, *back + margin);
    const int last = stepsInside(*line, scored, +1, *ahead, *ahead + margin);
    const double exact = width(scored.truth.visibility, *line, first, last);
    if (exact <= 0) return {};
    return std::abs(width(v, *line, first, last) - exact) / exact;
}

bool isGraded(const groundtruth::Reference& truth, const Mask& mask) {
    for (std::size_t i = 0; i < mask.scored.size(); ++i)
        if (mask.scored[i] && truth.visibility[i] > 0 && truth.visibility[i] < 1) return true;
    return false;
}

} // namespace

std::optional<double> penumbraWidthError(const ScoredFrame& frame) {
    requireComparable(frame);
    const auto& [v, truth, mask] = frame;
    if (!isGraded(truth, mask)) return {}; // a hard truth has no penumbra
    const Scored scored{truth, mask};
    std::vector<double> widthErrors;
    for (const Crossing& pair : crossings(truth.visibility, truth, mask))
        if (const std::optional<double> error = widthErrorAt(pair, v, scored)) widthErrors.push_back(*error);
    if (widthErrors.empty()) return {};
    return mean(widthErrors);
}

} // namespace shadowbench::metrics
