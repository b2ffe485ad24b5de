// Silhouette chains → edges in pixels → winding numbers → labels; then the distance to where the winding number becomes
// zero.
#include "groundtruth/cgal/polygon.h"

#include "groundtruth/cgal/edge_distance.h"
#include "groundtruth/cgal/parallel.h"
#include "groundtruth/cgal/primary.h"
#include "groundtruth/cgal/rays.h"
#include "groundtruth/cgal/scanline.h"
#include "harness/scene/error.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>

namespace shadowbench::groundtruth {
namespace {

/// The pixels that see the receiver.
Image<std::uint8_t> membersOf(const PlanarReceiver& receiver, const PrimaryHits& primary) {
    Image<std::uint8_t> members(primary.id.width(), primary.id.height());
    for (std::size_t i = 0; i < members.size(); ++i)
        members[i] = primary.surface[i] == Surface::Receiver && primary.id[i] == receiver.id &&
                     std::ranges::binary_search(receiver.triangles, primary.triangle[i]);
    return members;
}

std::vector<PixelEdge> shadowEdges(const SceneTriangles& scene, const glm::dvec4& light, const ShadowProjection& projection,
                                   glm::ivec2 size, int threads, const Progress& progress) {
    std::vector<std::vector<PixelEdge>> perInstance(scene.instances().size());
    forEachInParallel(static_cast<int>(perInstance.size()), threads, progress, "silhouettes", [&](int i) {
        perInstance[i] = toPixels(silhouette(scene.instances()[i], light, projection), size, projection.pixelError());
    });
    std::size_t count = 0;
    for (const std::vector<PixelEdge>& part : perInstance) count += part.size();
    std::vector<PixelEdge> edges;
    edges.reserve(count);
    for (std::vector<PixelEdge>& part : perInstance) {
        edges.insert(edges.end(), part.begin(), part.end());
        part = {};
    }
    return edges;
}

class PlaneLabels {
public:
    PlaneLabels(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                const PlanarReceiver& receiver, const Image<std::uint8_t>& members)
        : scene_(scene), camera_(camera), light_(light), size_(size),
          members_(members), name_{scene.instanceOf(receiver.id), receiver.triangles.front()},
          plane_(scene.triangle(name_)) {}

    /// Turns the changes of a row into winding numbers; −1 where they are not known.
    void addUp(int row, Winding& winding) const {
        int sum = 0;
        for (int x = 0; x < winding.change.width(); ++x) winding.change(x, row) = sum += winding.change(x, row);
        const std::optional<int> shift = rowShift(row, winding);
        for (int x = 0; x < winding.change.width(); ++x) {
            int& number = winding.change(x, row);
            number = shift && onPlane(x, row) ? number + *shift : unknown;
            if (number < 0 && number != unknown && winding.uncertain(x, row) == 0)
                throw InternalError("A winding number is negative in image row " + std::to_string(row - scanMargin) +
                                    ": the silhouettes of this scene are inconsistent; please report it.");
            number = std::max(number, unknown);
        }
    }

    /// Label of a pixel of the receiver.
    [[nodiscard]] Blocking label(int x, int y, const Winding& winding) const {
        const int number = winding.change(x + scanMargin, y + scanMargin);
        if (number == unknown || winding.uncertain(x + scanMargin, y + scanMargin))
            return shadowLabel(scene_, ReceiverPoint(pixelRay(camera_, x, y, size_), plane_), name_, light_);
        return number > 0 ? Blocking::Blocks : Blocking::None;
    }

private:
    static constexpr int unknown = -1;

    /// The scanline only knows changes along a row. One exact count of the triangles above a pixel anchors it, a second one
    /// checks.
    [[nodiscard]] std::optional<int> rowShift(int row, const Winding& winding) const {
        std::optional<int> first, last;
        const int width = winding.change.width();
        for (int x = 0; x < width && !first; ++x) first = shiftAt(x, row, winding);
        for (int x = width - 1; x >= 0 && !last; --x) last = shiftAt(x, row, winding);
        if (first != last)
            throw InternalError("Winding numbers disagree with the triangles above image row " +
                                std::to_string(row - scanMargin) + "; please report it.");
        return first;
    }

    [[nodiscard]] std::optional<int> shiftAt(int x, int row, const Winding& winding) const {
        if (winding.uncertain(x, row) || !onPlane(x, row)) return std::nullopt;
        const ReceiverPoint point(pixelRay(camera_, x - scanMargin, row - scanMargin, size_), plane_);
        const std::optional<int> count = coverCount(scene_, point, name_, light_);
        if (!count) return std::nullopt;
        return *count - winding.change(x, row);
    }

    /// Does the pixel look at the plane within reach? Pixels of the receiver do.
    [[nodiscard]] bool onPlane(int x, int row) const {
        if (members_.contains(x - scanMargin, row - scanMargin) && members_(x - scanMargin, row - scanMargin)) return true;
        const Ray ray = pixelRay(camera_, x - scanMargin, row - scanMargin, size_);
        const glm::dvec3 normal = glm::cross(plane_[1] - plane_[0], plane_[2] - plane_[0]);
        const double depth = glm::dot(normal, plane_[0] - ray.origin) / glm::dot(normal, ray.direction);
        return depth > 0.5 * camera_.near && depth < camera_.far;
    }

    const SceneTriangles& scene_;
    const Camera& camera_;
    const glm::dvec4& light_;
    glm::ivec2 size_;
    const Image<std::uint8_t>& members_;
    TriangleName name_;
    Triangle plane_;
};

} // namespace

void labelPlane(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size,
                const PrimaryHits& primary, const PlanarReceiver& receiver, int threads, Reference& out,
                const Progress& progress) {
    const Image<std::uint8_t> members = membersOf(receiver, primary);
    const Triangle plane = scene.triangle({scene.instanceOf(receiver.id), receiver.triangles.front()});
    const ShadowProjection projection(plane, light, camera, size);
    const std::vector<PixelEdge> edges = shadowEdges(scene, light, projection, size, threads, progress);
    Winding winding = scan(edges, size);

    const PlaneLabels labels(scene, camera, light, size, receiver, members);
    forEachInParallel(winding.change.height(), threads, {}, "winding", [&](int row) { labels.addUp(row, winding); });
    forEachInParallel(size.y, threads, {}, "labels", [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            if (!members(x, y)) continue;
            const Blocking found = labels.label(x, y, winding);
            out.visibility(x, y) = found == Blocking::Blocks ? 0.0F : 1.0F;
            out.surface(x, y) = found == Blocking::Touches ? Surface::OnEdge : Surface::Receiver;
            out.edgeDistance(x, y) = found == Blocking::Touches ? 0.0F : std::numeric_limits<float>::infinity();
        }
    });
    lowerToEdgeDistance(edges, winding.change, members, out.edgeDistance);
}

} // namespace shadowbench::groundtruth
