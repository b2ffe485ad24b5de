// Small synthetic frames with known answers.
#pragma once

#include "harness/metrics/frames.h"
#include "harness/metrics/values.h"

#include <cmath>
#include <limits>

namespace shadowbench::test {

/// A truth in which every pixel is a receiver of surface 1, one metre away, with visibility `value(centre)`.
template <typename Value>
groundtruth::Reference truthOf(int width, int height, const Value& value) {
    groundtruth::Reference truth;
    truth.visibility = Image<float>(width, height);
    truth.sigma = Image<float>(width, height, 0);
    truth.surface = Image<groundtruth::Surface>(width, height, groundtruth::Surface::Receiver);
    truth.id = Image<std::uint32_t>(width, height, 1);
    truth.position = Image<glm::vec3>(width, height, glm::vec3(0, 0, -1));
    truth.edgeDistance = Image<float>(width, height, std::numeric_limits<float>::infinity());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) truth.visibility(x, y) = static_cast<float>(value(glm::dvec2(x + 0.5, y + 0.5)));
    return truth;
}

template <typename Value>
Image<float> imageOf(int width, int height, const Value& value) {
    return truthOf(width, height, value).visibility;
}

inline metrics::Mask everything(const groundtruth::Reference& truth) {
    return {Image<std::uint8_t>(truth.id.width(), truth.id.height(), 1), 0, truth.id.size()};
}

/// The metrics of graded visibility.
inline metrics::Values visibilityOf(const metrics::ScoredFrame& frame) {
    metrics::Values values;
    metrics::compute<metrics::OfVisibility>(frame, values);
    return values;
}

/// A straight shadow edge: lit where the signed distance `normal · p − offset` is positive (normal of unit length).
struct HalfPlane {
    glm::dvec2 normal;
    double offset;
    [[nodiscard]] double distance(glm::dvec2 p) const { return normal.x * p.x + normal.y * p.y - offset; }
    [[nodiscard]] double hard(glm::dvec2 p) const { return distance(p) > 0 ? 1 : 0; }

    /// A linear penumbra of `width` pixels across the edge.
    [[nodiscard]] double ramp(glm::dvec2 p, double width) const { return std::clamp(0.5 + distance(p) / width, 0.0, 1.0); }

    [[nodiscard]] HalfPlane moved(double pixels) const { return {normal, offset + pixels}; }

    /// Its hard truth with the exact distance field.
    [[nodiscard]] groundtruth::Reference truth(int width, int height) const {
        groundtruth::Reference result = truthOf(width, height, [&](glm::dvec2 p) { return hard(p); });
        result.edgeDistance = imageOf(width, height, [&](glm::dvec2 p) { return std::abs(distance(p)); });
        return result;
    }
};

} // namespace shadowbench::test
