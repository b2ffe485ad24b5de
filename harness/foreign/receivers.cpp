#include "harness/foreign/receivers.h"

#include "base/error.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench::foreign {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;

constexpr std::uint32_t anySurface = std::numeric_limits<std::uint32_t>::max(); // hit where the truth has none

bool isDistance(float depth) {
    constexpr float nothing = 1e9F;      // what renderers write where nothing was hit
    return depth > 0 && depth < nothing; // false for a NaN
}

/// One over the distance along the view: over a plane it changes evenly from pixel to pixel.
double inverseDepth(const Reference& truth, glm::ivec2 at, const Camera& camera, const glm::dvec3& forward) {
    return 1 / glm::dot(glm::dvec3(truth.position(at.x, at.y)) - camera.eye, forward);
}

/// Whether the surface at `p` steps towards or away from the eye between two opposite neighbours.
bool steps(const Reference& truth, glm::ivec2 p, glm::ivec2 by, const Camera& camera, const glm::dvec3& forward) {
    constexpr double notable = 0.01; // of the depth, in one pixel beyond what the plane's slope makes
    const glm::ivec2 a = p - by, b = p + by;
    if (!truth.id.contains(a.x, a.y) || !truth.id.contains(b.x, b.y)) return false;
    const double here = inverseDepth(truth, p, camera, forward);
    const double bend = inverseDepth(truth, a, camera, forward) + inverseDepth(truth, b, camera, forward) - 2 * here;
    return std::abs(bend) > notable * here;
}

bool sameFace(const Reference& truth, glm::ivec2 p, glm::ivec2 q) {
    const auto facesLight = [&](glm::ivec2 at) {
        const Surface surface = truth.surface(at.x, at.y);
        return surface == Surface::Receiver || surface == Surface::OnEdge;
    };
    return truth.id(p.x, p.y) == truth.id(q.x, q.y) && facesLight(p) == facesLight(q);
}

bool isEdge(const Reference& truth, glm::ivec2 p, const Camera& camera, const glm::dvec3& forward) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::ivec2 q = p + glm::ivec2(dx, dy);
            if (truth.id.contains(q.x, q.y) && !sameFace(truth, p, q)) return true;
        }
    if (truth.id(p.x, p.y) == 0) return false;
    return steps(truth, p, {1, 0}, camera, forward) || steps(truth, p, {0, 1}, camera, forward);
}

/// Throws BadInput unless all but few primary hits agree away from geometry's edges, where renderers may see another
/// surface than the one at the pixel's centre.
void requireAligned(const Reference& truth, const metrics::Mask& mask, const Camera& camera, const FrameFiles& files) {
    constexpr double mostDisagreeing = 0.001; // as of this program's own rasteriser: harness/metrics/mask.cpp
    const Pixels edges = geometryEdges(truth, camera);
    std::size_t inside = 0, wrong = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (edges[i] != 0 || truth.surface[i] != Surface::Receiver) continue;
        ++inside;
        if (mask.scored[i] == 0) ++wrong;
    }
    if (static_cast<double>(wrong) <= mostDisagreeing * static_cast<double>(inside)) return;
    throw BadInput(fmt::format(
        "image {} shows another geometry than frame {} has at {:.2g} % of the receivers that are no edge (limit 0.1 %): "
        "camera, transforms, frame, rows' order or the meaning of depth (--depth-is) differ, so nothing is scored",
        files.depth.value_or(files.hits.value_or(files.image)).string(), files.frame,
        100 * static_cast<double>(wrong) / static_cast<double>(inside)));
}

} // namespace

metrics::Drawn drawnBy(const Reference& truth, const Camera& camera, const Image<float>* hits, const Image<float>* depth,
                       Depth kind) {
    const glm::ivec2 size(truth.id.width(), truth.id.height());
    metrics::Drawn drawn{Image<std::uint32_t>(size.x, size.y), Image<glm::vec3>(size.x, size.y)};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const bool hit = (hits == nullptr || (*hits)(x, y) > 0.5F) && (depth == nullptr || isDistance((*depth)(x, y)));
            const bool known = truth.id(x, y) != 0;
            drawn.id(x, y) = !hit ? 0 : known ? truth.id(x, y) : anySurface;
            drawn.position(x, y) = truth.position(x, y);
            if (!hit || depth == nullptr) continue;
            glm::dvec3 ray = camera.ray({x + 0.5, y + 0.5}, size);
            if (kind == Depth::FromEye) ray = glm::normalize(ray);
            drawn.position(x, y) = glm::vec3(camera.eye + static_cast<double>((*depth)(x, y)) * ray);
        }
    return drawn;
}

Pixels geometryEdges(const Reference& truth, const Camera& camera) {
    Pixels edges(truth.id.width(), truth.id.height());
    const glm::dvec3 forward = camera.basis().forward;
    for (int y = 0; y < edges.height(); ++y)
        for (int x = 0; x < edges.width(); ++x) edges(x, y) = isEdge(truth, {x, y}, camera, forward) ? 1 : 0;
    return edges;
}

metrics::Mask withoutPixels(const metrics::Mask& mask, const Pixels& without) {
    metrics::Mask result = mask;
    for (std::size_t i = 0; i < without.size(); ++i) {
        if (without[i] == 0 || result.scored[i] == 0) continue;
        result.scored[i] = 0;
        --result.count;
    }
    return result;
}

void RowReceivers::show(const FrameFiles& files) {
    files_ = files;
    leftOut_ = {};
    hits_.reset();
    depth_.reset();
    const glm::ivec2 size = frames_.scene().size;
    if (files.hits) hits_ = readNumbers(*files.hits, size);
    if (files.depth) depth_ = readNumbers(*files.depth, size);
}

metrics::Mask RowReceivers::seen(Truth truth) {
    if (!hits_ && !depth_) return frames_.mask(truth);
    const Reference& reference = frames_.truth(truth);
    const Camera& camera = frames_.stage().shown().camera;
    const metrics::Drawn drawn =
        drawnBy(reference, camera, hits_ ? &*hits_ : nullptr, depth_ ? &*depth_ : nullptr, row_.depth);
    metrics::Mask mask = metrics::receiverMask(reference, drawn, camera.eye);
    requireAligned(reference, mask, camera, files_);
    mask.aligned = true;
    return mask;
}

const metrics::Mask& RowReceivers::scored(Truth truth) {
    const std::pair key(truth, files_.frame);
    if (const auto found = masks_.find(key); found != masks_.end()) return found->second;
    metrics::Mask mask = seen(truth);
    if (!leftOut_.empty()) {
        const std::size_t all = mask.count;
        mask = withoutPixels(mask, leftOut_);
        mask.primaryMismatch += static_cast<double>(all - mask.count) / static_cast<double>(mask.scored.size());
    }
    if (row_.leaveOutEdges) mask = withoutPixels(mask, geometryEdges(frames_.truth(truth), frames_.stage().shown().camera));
    return masks_.emplace(key, std::move(mask)).first->second;
}

} // namespace shadowbench::foreign
