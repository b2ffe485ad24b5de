// Stability over time: reprojection, flicker, flips, convergence.
#include "base/error.h"
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <unordered_map>

namespace shadowbench::metrics {
namespace {

constexpr double sameDistance = 5e-3; // relative difference of eye distances of one surface point in two frames
const glm::vec2 nowhere(std::numeric_limits<float>::quiet_NaN());

/// World position in the previous frame from the one in this frame, for every surface that moved.
std::unordered_map<std::uint32_t, glm::dmat4> motions(const Snapshot& now) {
    std::unordered_map<std::uint32_t, glm::dmat4> result;
    for (const Batch& batch : now.batches)
        for (const Placement& placement : batch.placements)
            if (placement.world != placement.previous)
                result[placement.id] = placement.previous * glm::inverse(placement.world);
    return result;
}

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

bool isSomewhere(glm::vec2 position) { return std::isfinite(position.x) && std::isfinite(position.y); }

void requireOneSize(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp) {
    requireComparable(*now.v, *now.truth, *now.mask);
    requireComparable(*before.v, *before.truth, *before.mask);
    if (!warp.sameSize(*now.v) || !now.v->sameSize(*before.v))
        throw InternalError("comparing frames of different sizes; render both at one size");
}

/// The pixel that contains an image position, if it is in M on surface `id`.
std::optional<glm::ivec2> nearestPixel(const FrameResult& frame, glm::vec2 position, std::uint32_t id) {
    const glm::ivec2 pixel(glm::floor(position));
    if (!frame.v->contains(pixel.x, pixel.y) || !frame.mask->scored(pixel.x, pixel.y)) return {};
    if (frame.truth->id(pixel.x, pixel.y) != id) return {};
    return pixel;
}

/// V and V* of the previous frame at a reprojected position.
struct Pair {
    double v, exact;
};
std::optional<Pair> lookUp(const FrameResult& frame, glm::vec2 position, std::uint32_t id) {
    const Bilinear around{glm::dvec2(position)};
    if (around.within(*frame.mask, frame.truth->id, id)) return Pair{around(*frame.v), around(frame.truth->visibility)};
    const std::optional<glm::ivec2> nearest = nearestPixel(frame, position, id);
    if (!nearest) return {};
    return Pair{(*frame.v)(nearest->x, nearest->y), frame.truth->visibility(nearest->x, nearest->y)};
}

} // namespace

Image<glm::vec2> warp(const Snapshot& now, glm::ivec2 size, const groundtruth::Reference& truth,
                      const groundtruth::Reference& before) {
    if (truth.id.width() != size.x || truth.id.height() != size.y || !truth.position.sameSize(truth.id) ||
        !before.id.sameSize(truth.id) || !before.position.sameSize(truth.id))
        throw InternalError("reprojecting between references of different sizes; compute both at one size");
    const std::unordered_map<std::uint32_t, glm::dmat4> moved = motions(now);
    Image<glm::vec2> result(size.x, size.y, nowhere);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::uint32_t id = truth.id[i];
        if (id == 0) continue;
        glm::dvec3 point(truth.position[i]);
        if (const auto motion = moved.find(id); motion != moved.end()) point = motion->second * glm::dvec4(point, 1);
        result[i] = previousPosition(point, id, now.previousCamera, before);
    }
    return result;
}

void flickerSamples(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp,
                    std::vector<float>& samples) {
    requireOneSize(now, before, warp);
    for (std::size_t i = 0; i < warp.size(); ++i) {
        if (!now.mask->scored[i] || !isSomewhere(warp[i])) continue;
        const std::optional<Pair> previous = lookUp(before, warp[i], now.truth->id[i]);
        if (!previous) continue;
        const double change = (*now.v)[i] - previous->v;
        const double exactChange = now.truth->visibility[i] - previous->exact;
        samples.push_back(static_cast<float>(std::abs(change - exactChange)));
    }
}

std::optional<Flicker> flicker(std::vector<float> samples) {
    if (samples.empty()) return {};
    std::vector<double> values(samples.begin(), samples.end());
    Flicker result;
    result.mean = mean(values);
    result.p95 = quantile(values, 0.95);
    return result;
}

Flips flips(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp) {
    requireOneSize(now, before, warp);
    Flips result;
    for (std::size_t i = 0; i < warp.size(); ++i) {
        if (!now.mask->scored[i] || !isSomewhere(warp[i])) continue;
        const std::optional<glm::ivec2> previous = nearestPixel(before, warp[i], now.truth->id[i]);
        if (!previous) continue;
        ++result.compared;
        const bool changed = isLit((*now.v)[i]) != isLit((*before.v)(previous->x, previous->y));
        const bool truthChanged =
            isLit(now.truth->visibility[i]) != isLit(before.truth->visibility(previous->x, previous->y));
        if (changed && !truthChanged) ++result.flipped;
    }
    return result;
}

std::optional<double> SquareSum::root() const {
    return count > 0 ? std::optional(std::sqrt(sum / static_cast<double>(count))) : std::nullopt;
}

void addMovingError(const FrameResult& now, const Image<glm::vec2>& warp, MovingError& error) {
    requireComparable(*now.v, *now.truth, *now.mask);
    for (std::size_t i = 0; i < warp.size(); ++i) {
        if (!now.mask->scored[i]) continue;
        const double difference = (*now.v)[i] - now.truth->visibility[i];
        const auto add = [&](SquareSum& sum) {
            sum.sum += difference * difference;
            ++sum.count;
        };
        add(error.all);
        if (!isSomewhere(warp[i])) add(error.disoccluded);
    }
}

std::optional<int> convergence(const std::vector<double>& errorByFrame) {
    if (errorByFrame.empty()) return {};
    const std::size_t last = std::max<std::size_t>(1, errorByFrame.size() / 10);
    const double steady = mean({errorByFrame.end() - static_cast<std::ptrdiff_t>(last), errorByFrame.end()});
    std::size_t frame = errorByFrame.size();
    while (frame > 0 && errorByFrame[frame - 1] <= 1.05 * steady) --frame;
    if (frame == errorByFrame.size()) return {};
    return static_cast<int>(frame) + 1;
}

} // namespace shadowbench::metrics
