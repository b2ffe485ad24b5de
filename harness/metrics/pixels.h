// What the metrics share: loops over the mask, edge crossings, bilinear reading.
#pragma once

#include "harness/metrics/frames.h"
#include "harness/metrics/scores.h"

#include <optional>
#include <vector>

namespace shadowbench::metrics {

inline bool isLit(float visibility) { return visibility >= 0.5F; }

/// Throws InternalError unless all images have M's size and V is finite inside M.
void requireComparable(const ScoredFrame& frame);

/// A pair of neighbouring pixels of M on one surface with different labels.
struct Crossing {
    glm::ivec2 a, b; // b is right of or below a
};
std::vector<Crossing> crossings(const Image<float>& image, const groundtruth::Reference& truth, const Mask& mask);

/// The image position `share` of the way from a's centre to b's.
glm::dvec2 between(const Crossing& pair, double share);

/// Where `image`, linear between the two centres, is ½.
double halfCrossing(const Image<float>& image, const Crossing& pair);

/// The 2 × 2 pixels around an image position and their bilinear weights; pixels of weight 0 may lie outside the image.
struct Bilinear {
    glm::ivec2 pixels[4];
    double weights[4];
    explicit Bilinear(glm::dvec2 position);
    [[nodiscard]] double operator()(const Image<float>& image) const;

    /// Every pixel with a weight lies in M on surface `id`.
    [[nodiscard]] bool within(const Mask& mask, const Image<std::uint32_t>& ids, std::uint32_t id) const;
};

/// Whether a warp leads to somewhere in the frame before.
bool isSomewhere(glm::vec2 position);

/// The pixel that contains an image position, if it is in M on surface `id`.
std::optional<glm::ivec2> nearestPixel(const ScoredFrame& frame, glm::vec2 position, std::uint32_t id);

/// How V and V* changed at a pixel from the frame before.
struct Change {
    double drawn, exact;
};

/// Of every pixel of both masks that the frame before shows (see `flicker` in table.h).
std::vector<Change> changes(const FramePair& pair);

/// What `flicker` is the mean of, at the pixels of `pair.now`; 0 where a pixel has no change.
Image<float> flickerMap(const FramePair& pair);

/// Reprojected pixels whose class changed while the truth's did not, and how many were compared (see `flipRate`).
struct Flips {
    std::size_t flipped = 0, compared = 0;
};
Flips flips(const FramePair& pair);

/// The q-quantile by nearest rank; sorts in place. Not for empty sets.
double quantile(std::vector<double>& values, double q);
double mean(const std::vector<double>& values);

} // namespace shadowbench::metrics
