#include "site/viewer/shadow_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <optional>

namespace shadowbench::site {
namespace {

constexpr float receiver = 2; // groundtruth::Surface::Receiver
constexpr float onEdge = 3;   // groundtruth::Surface::OnEdge

/// Positive in light, negative in shadow, 0 on the edge; nothing where that is not known.
std::optional<float> side(const KeptTruth& truth, bool exact, int x, int y) {
    if (truth.surface(x, y) == onEdge) return 0.0F;
    if (truth.surface(x, y) != receiver) return std::nullopt;
    const float lit = truth.visibility(x, y) - 0.5F;
    if (!exact) return lit;
    const float distance = truth.edgeDistance(x, y);
    if (!std::isfinite(distance)) return std::nullopt;
    return lit > 0 ? distance : -distance;
}

/// Between two neighbouring pixel centres, of one surface.
std::optional<glm::vec2> crossing(const KeptTruth& truth, bool exact, glm::ivec2 a, glm::ivec2 b) {
    const std::optional<float> at = side(truth, exact, a.x, a.y), to = side(truth, exact, b.x, b.y);
    if (!at || !to || (*at < 0) == (*to < 0)) return std::nullopt;
    const float share = *at / (*at - *to);
    return glm::vec2(a) + 0.5F + share * glm::vec2(b - a);
}

bool isOneSurface(const KeptTruth& truth, int x, int y) {
    const float id = truth.id(x, y);
    return truth.id(x + 1, y) == id && truth.id(x, y + 1) == id && truth.id(x + 1, y + 1) == id;
}

void append(std::vector<float>& segments, glm::vec2 from, glm::vec2 to) {
    segments.insert(segments.end(), {from.x, from.y, to.x, to.y});
}

/// The pieces of the edge between four pixel centres, of which (x, y) is the upper left.
void appendEdges(const KeptTruth& truth, bool exact, int x, int y, std::vector<float>& segments) {
    const std::array<glm::ivec2, 4> corners{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
    std::vector<glm::vec2> points;
    for (std::size_t i = 0; i < 4; ++i)
        if (const auto point = crossing(truth, exact, corners[i], corners[(i + 1) % 4])) points.push_back(*point);
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) append(segments, points[i], points[i + 1]);
}

} // namespace

bool hasExactEdges(const KeptTruth& truth) {
    return std::ranges::any_of(truth.edgeDistance, [](float distance) { return std::isfinite(distance); });
}

std::vector<float> shadowEdges(const KeptTruth& truth) {
    const bool exact = hasExactEdges(truth);
    std::vector<float> segments;
    for (int y = 0; y + 1 < truth.id.height(); ++y)
        for (int x = 0; x + 1 < truth.id.width(); ++x)
            if (isOneSurface(truth, x, y)) appendEdges(truth, exact, x, y, segments);
    return segments;
}

} // namespace shadowbench::site
