// A frame with exact shadow edges, and images of them that are as wrong as a test wants.
#pragma once

#include "harness/metrics/frames.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace shadowbench::foreign {

/// Distance to the edge of two disks and a bar, in pixels, negative in their shadows.
inline double distanceAt(double x, double y) {
    const double disk = std::hypot(x - 40, y - 30) - 22, small = std::hypot(x - 98, y - 84) - 13;
    const double bar = std::max(std::abs(x - 30) - 7, std::abs(y - 95) - 19);
    return std::min({disk, small, bar});
}

/// All of it are receivers on one surface.
struct ExactEdges {
    static constexpr int side = 128;

    ExactEdges() {
        truth.visibility = Image<float>(side, side);
        truth.edgeDistance = Image<float>(side, side);
        truth.surface = Image<groundtruth::Surface>(side, side, groundtruth::Surface::Receiver);
        truth.id = Image<std::uint32_t>(side, side, 1);
        mask.scored = Image<std::uint8_t>(side, side, 1);
        mask.count = side * side;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double distance = distanceAt(x + 0.5, y + 0.5);
                truth.visibility(x, y) = distance > 0 ? 1 : 0;
                truth.edgeDistance(x, y) = static_cast<float>(std::abs(distance));
            }
    }

    /// Lit where `distance` of a pixel's centre is above 0, over a ramp of `width` pixels.
    static Image<float> drawn(double width, const std::function<double(double, double)>& distance) {
        Image<float> image(side, side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                image(x, y) = static_cast<float>(std::clamp(0.5 + distance(x + 0.5, y + 0.5) / width, 0.0, 1.0));
        return image;
    }

    groundtruth::Reference truth;
    metrics::Mask mask;
};

} // namespace shadowbench::foreign
