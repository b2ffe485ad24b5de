// Stability over time: reprojection, flicker, flips, convergence.
#include "base/error.h"
#include "harness/metrics/pixels.h"
#include "harness/metrics/surface_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench::metrics {
namespace {

constexpr double sameDistance = 5e-3; // relative difference of eye distances of one surface point in two frames
constexpr double leastMotion = 1e-3;  // degrees a frame: below this, positions in 32 bits seem to move
const glm::vec2 nowhere(std::numeric_limits<float>::quiet_NaN());

bool showsSurface(const groundtruth::Reference& before, glm::ivec2 pixel, std::uint32_t id, const glm::dvec3& point,
                  const glm::dvec3& eye) {
    if (!before.id.contains(pixel.x, pixel.y) || before.id(pixel.x, pixel.y) != id) return false;
    const double expected = glm::distance(point, eye);
    const double seen = glm::distance(glm::dvec3(before.position(pixel.x, pixel.y)), eye);
    return std::abs(seen - expected) <= sameDistance * expected;
}

glm::vec2 previousPosition(const glm::dvec3& point, std::uint32_t id, const Camera& camera,
                           const groundtruth::Reference& before) {
    const glm::ivec2 size(before.id.width(), before.id.height());
    const glm::dvec3 image = camera.project(point, size);
    const bool inside = image.z > 0 && image.x >= 0 && image.y >= 0 && image.x < size.x && image.y < size.y;
    if (!inside) return nowhere;
    const Bilinear around{glm::dvec2(image)};
    for (const glm::ivec2 pixel : around.pixels)
        if (showsSurface(before, pixel, id, point, camera.eye)) return glm::vec2(image);
    return nowhere;
}

void requireOneSize(const FramePair& pair) {
    requireComparable(pair.now);
    requireComparable(pair.before);
    if (!pair.warp.sameSize(pair.now.v) || !pair.now.v.sameSize(pair.before.v))
        throw InternalError("comparing frames of different sizes; render both at one size");
}

/// V and V* of the previous frame at a reprojected position.
struct Looked {
    double v, exact;
};
std::optional<Looked> lookUp(const ScoredFrame& frame, glm::vec2 position, std::uint32_t id) {
    const Bilinear around{glm::dvec2(position)};
    if (around.within(frame.mask, frame.truth.id, id)) return Looked{around(frame.v), around(frame.truth.visibility)};
    const std::optional<glm::ivec2> nearest = nearestPixel(frame, position, id);
    if (!nearest) return {};
    return Looked{frame.v(nearest->x, nearest->y), frame.truth.visibility(nearest->x, nearest->y)};
}

/// Calls `found` with the index and the change of every pixel of both masks that the frame before shows.
template <class Found>
void forEachChange(const FramePair& pair, const Found& found) {
    requireOneSize(pair);
    const auto& [now, before, warp] = pair;
    for (std::size_t i = 0; i < warp.size(); ++i) {
        if (!now.mask.scored[i] || !isSomewhere(warp[i])) continue;
        const std::optional<Looked> previous = lookUp(before, warp[i], now.truth.id[i]);
        if (previous) found(i, Change{now.v[i] - previous->v, now.truth.visibility[i] - previous->exact});
    }
}

/// Squares of V − V*, summed over pixels and frames.
struct SquareSum {
    double sum = 0;
    std::size_t count = 0;

    void add(double difference) {
        sum += difference * difference;
        ++count;
    }
    [[nodiscard]] std::optional<double> root() const { // of the mean; nothing over nothing
        return count > 0 ? std::optional(std::sqrt(sum / static_cast<double>(count))) : std::nullopt;
    }
};

std::optional<double> quotient(std::size_t part, std::size_t all) {
    return all > 0 ? std::optional(static_cast<double>(part) / static_cast<double>(all)) : std::nullopt;
}

} // namespace

Image<glm::vec2> warp(const Snapshot& now, glm::ivec2 size, const groundtruth::Reference& truth,
                      const groundtruth::Reference& before) {
    if (truth.id.width() != size.x || truth.id.height() != size.y || !truth.position.sameSize(truth.id) ||
        !before.id.sameSize(truth.id) || !before.position.sameSize(truth.id))
        throw InternalError("reprojecting between references of different sizes; compute both at one size");
    const SurfaceMotion motion(now);
    Image<glm::vec2> result(size.x, size.y, nowhere);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::uint32_t id = truth.id[i];
        if (id == 0) continue;
        const glm::dvec3 point = motion.before(id, glm::dvec3(truth.position[i]));
        result[i] = previousPosition(point, id, now.previousCamera, before);
    }
    return result;
}

std::vector<Change> changes(const FramePair& pair) {
    std::vector<Change> result;
    forEachChange(pair, [&](std::size_t, const Change& change) { result.push_back(change); });
    return result;
}

Image<float> flickerMap(const FramePair& pair) {
    Image<float> result(pair.warp.width(), pair.warp.height());
    forEachChange(pair, [&](std::size_t i, const Change& change) {
        result[i] = static_cast<float>(std::abs(change.drawn - change.exact));
    });
    return result;
}

Flips flips(const FramePair& pair) {
    requireOneSize(pair);
    const auto& [now, before, warp] = pair;
    Flips result;
    for (std::size_t i = 0; i < warp.size(); ++i) {
        if (!now.mask.scored[i] || !isSomewhere(warp[i])) continue;
        const std::optional<glm::ivec2> previous = nearestPixel(before, warp[i], now.truth.id[i]);
        if (!previous) continue;
        ++result.compared;
        const bool changed = isLit(now.v[i]) != isLit(before.v(previous->x, previous->y));
        const bool truthChanged = isLit(now.truth.visibility[i]) != isLit(before.truth.visibility(previous->x, previous->y));
        if (changed && !truthChanged) ++result.flipped;
    }
    return result;
}

std::optional<Flicker> flicker(const MovingFrames& frames) {
    std::vector<double> values;
    double exact = 0;
    for (const FramePair& pair : frames.pairs) {
        for (const Change& change : changes(pair)) {
            values.push_back(static_cast<float>(std::abs(change.drawn - change.exact)));
            exact += std::abs(change.exact);
        }
    }
    if (values.empty()) return {};
    Flicker result;
    result.mean = mean(values);
    result.p95 = quantile(values, 0.95);
    result.floor = exact / static_cast<double>(values.size());
    const double aFrame = frames.motion / static_cast<double>(frames.pairs.size());
    if (aFrame > leastMotion) result.perDegree = result.mean / aFrame;
    return result;
}

std::optional<double> flipRate(const MovingFrames& frames) {
    Flips all;
    for (const FramePair& pair : frames.pairs) {
        const Flips here = flips(pair);
        all.flipped += here.flipped;
        all.compared += here.compared;
    }
    return quotient(all.flipped, all.compared);
}

MovingErrors movingErrors(const MovingFrames& frames) {
    SquareSum all, disoccluded;
    for (const FramePair& pair : frames.pairs) {
        requireComparable(pair.now);
        const auto& [v, truth, mask] = pair.now;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (!mask.scored[i]) continue;
            const double difference = v[i] - truth.visibility[i];
            all.add(difference);
            if (!isSomewhere(pair.warp[i])) disoccluded.add(difference);
        }
    }
    return {all.root(), disoccluded.root()};
}

MovingPixels movingPixels(const MovingFrames& frames) {
    MovingPixels pixels;
    for (const FramePair& pair : frames.pairs) {
        pixels.compared += static_cast<double>(flips(pair).compared);
        for (std::size_t i = 0; i < pair.warp.size(); ++i) {
            if (!pair.now.mask.scored[i]) continue;
            ++pixels.all;
            if (!isSomewhere(pair.warp[i])) ++pixels.disoccluded;
        }
    }
    return pixels;
}

std::optional<double> reuse(const MovingFrames& frames) {
    std::size_t surface = 0, seenBefore = 0;
    for (const FramePair& pair : frames.pairs)
        for (std::size_t i = 0; i < pair.warp.size(); ++i) {
            if (pair.now.truth.surface[i] == groundtruth::Surface::Background) continue;
            ++surface;
            if (isSomewhere(pair.warp[i])) ++seenBefore;
        }
    return quotient(seenBefore, surface);
}

std::optional<int> convergence(const StillFrames& frames) {
    const std::vector<double>& errors = frames.errors;
    if (errors.empty()) return {};
    const std::size_t last = std::max<std::size_t>(1, errors.size() / 10);
    const double steady = mean({errors.end() - static_cast<std::ptrdiff_t>(last), errors.end()});
    std::size_t frame = errors.size();
    while (frame > 0 && errors[frame - 1] <= 1.05 * steady) --frame;
    if (frame == errors.size()) return {};
    return static_cast<int>(frame) + 1;
}

std::vector<double> changedByFrame(const StillFrames& frames) {
    std::vector<double> shares;
    for (const Image<std::uint8_t>& picture : frames.pictures) {
        std::size_t changed = 0;
        for (std::size_t i = 0; i < picture.size(); ++i)
            if (frames.mask.scored[i] != 0 && std::abs(picture[i] - frames.pictures.back()[i]) > 30) ++changed;
        shares.push_back(static_cast<double>(changed) / static_cast<double>(frames.mask.count));
    }
    return shares;
}

Image<std::uint8_t> inBytes(const Image<float>& v) {
    Image<std::uint8_t> bytes(v.width(), v.height());
    std::transform(v.begin(), v.end(), bytes.begin(),
                   [](float x) { return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(x, 0.0F, 1.0F))); });
    return bytes;
}

} // namespace shadowbench::metrics
