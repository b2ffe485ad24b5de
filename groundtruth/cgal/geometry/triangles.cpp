#include "groundtruth/cgal/geometry/triangles.h"

#include "base/error.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <string>

namespace shadowbench::groundtruth::geometry {
namespace {

constexpr double unit = 0x1p-53; // relative rounding error of one operation; the counts of operations below are rounded up

glm::dmat3 absolute(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

float below(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

float above(double value) { return -below(-value); }

std::vector<FloatBox> triangleBoxes(const Mesh& mesh) {
    std::vector<FloatBox> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    }
    return boxes;
}

glm::dvec3 largestCoordinates(const FloatBox& box) {
    return glm::max(glm::abs(glm::dvec3(box.low)), glm::abs(glm::dvec3(box.high)));
}

/// Bounds the rounding of worldVertex.
glm::dvec3 vertexError(const glm::dmat4& world, const glm::dvec3& largest) {
    return 8 * unit * (absolute(glm::dmat3(world)) * largest + glm::abs(glm::dvec3(world[3])));
}

/// With N the computed inverse, n the shift and w = M p + t + e a world vertex: N w + n − p = (N M − I) p + (N t + n) + N e.
glm::dvec3 inverseSlack(const TriangleInstance& instance, const glm::dvec3& largest) {
    const glm::dmat3 m(instance.world), &inverse = instance.toObject;
    const glm::dvec3 t(instance.world[3]);
    const glm::dmat3 magnitude = absolute(inverse) * absolute(m);
    const glm::dmat3 residual = absolute(inverse * m - glm::dmat3(1)) + 8 * unit * (magnitude + glm::dmat3(1));
    const glm::dvec3 offset =
        glm::abs(inverse * t + instance.shift) + 8 * unit * (absolute(inverse) * glm::abs(t) + glm::abs(instance.shift));
    return 2.0 * (residual * largest + offset + absolute(inverse) * vertexError(instance.world, largest));
}

FloatBox worldBox(const FloatBox& box, const glm::dmat4& world) {
    const Bounds bounds = transformed({glm::dvec3(box.low), glm::dvec3(box.high)}, world);
    const glm::dvec3 margin = 2.0 * vertexError(world, largestCoordinates(box));
    const glm::dvec3 low = bounds.low - margin, high = bounds.high + margin;
    return {{below(low.x), below(low.y), below(low.z)}, {above(high.x), above(high.y), above(high.z)}};
}

FloatBox meshBox(const Mesh& mesh) {
    FloatBox box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& position : mesh.positions) {
        box.low = glm::min(box.low, position);
        box.high = glm::max(box.high, position);
    }
    return box;
}

TriangleInstance makeInstance(const Batch& batch, const Placement& placement, std::size_t tree, const FloatBox& box) {
    const glm::dmat3 toObject = glm::inverse(glm::dmat3(placement.world));
    TriangleInstance instance{.mesh = batch.mesh,
                              .tree = tree,
                              .world = placement.world,
                              .id = placement.id,
                              .toObject = toObject,
                              .magnitude = absolute(toObject),
                              .largest = largestCoordinates(box),
                              .shift = -(toObject * glm::dvec3(placement.world[3])),
                              .slack = {},
                              .box = worldBox(box, placement.world)};
    instance.slack = inverseSlack(instance, instance.largest);
    if (!std::isfinite(instance.slack.x + instance.slack.y + instance.slack.z))
        throw BadInput("The placement of surface " + std::to_string(placement.id) +
                       " flattens its mesh or is not finite; give it a scale that is not zero.");
    return instance;
}

} // namespace

SceneTriangles::SceneTriangles(const Snapshot& snapshot) {
    std::map<const Mesh*, std::size_t> treeOf;
    std::vector<FloatBox> boxes;
    for (const Batch& batch : snapshot.batches) {
        if (batch.mesh->triangles.empty()) continue;
        const auto [found, isNew] = treeOf.try_emplace(batch.mesh.get(), trees_.size());
        if (isNew) {
            MeshTree& added = trees_.emplace_back();
            added.mesh = batch.mesh;
            added.box = meshBox(*batch.mesh);
        }
        const FloatBox& box = trees_[found->second].box;
        for (const Placement& placement : batch.placements) {
            if (!indexOf_.try_emplace(placement.id, static_cast<std::uint32_t>(instances_.size())).second)
                throw InternalError("Two placements of the snapshot share surface id " + std::to_string(placement.id) + ".");
            instances_.push_back(makeInstance(batch, placement, found->second, box));
            boxes.push_back(instances_.back().box);
        }
    }
    top_ = Bvh(boxes);
}

const Bvh& SceneTriangles::tree(std::size_t index) const {
    MeshTree& entry = trees_[index];
    std::call_once(entry.built, [&] { entry.tree = Bvh(triangleBoxes(*entry.mesh)); });
    return entry.tree;
}

std::uint32_t SceneTriangles::instanceOf(std::uint32_t id) const {
    const auto found = indexOf_.find(id);
    if (found == indexOf_.end()) throw InternalError("The snapshot has no surface " + std::to_string(id) + ".");
    return found->second;
}

Triangle SceneTriangles::triangle(TriangleName name) const {
    const TriangleInstance& instance = instances_[name.instance];
    const glm::uvec3& corner = instance.mesh->triangles[name.triangle];
    const std::vector<glm::vec3>& positions = instance.mesh->positions;
    return {worldVertex(instance.world, positions[corner.x]), worldVertex(instance.world, positions[corner.y]),
            worldVertex(instance.world, positions[corner.z])};
}

double SceneTriangles::reachFrom(const glm::dvec3& point) const {
    if (top_.empty()) return 0;
    const glm::dvec3 low(top_.bounds().low), high(top_.bounds().high);
    return 1.01 * (glm::length(high - low) + glm::distance(point, low));
}

PaddedSegment SceneTriangles::padded(const ApproximateSegment& segment) const {
    const glm::dvec3 reach = glm::abs(segment.from) + glm::abs(segment.to) + largestCoordinates(top_.bounds());
    return {segment.from, segment.to, segment.error + 32 * unit * reach};
}

PaddedSegment SceneTriangles::padded(const ApproximateSegment& segment, const TriangleInstance& instance) const {
    const glm::dvec3 from = instance.toObject * segment.from + instance.shift;
    const glm::dvec3 to = instance.toObject * segment.to + instance.shift;
    const glm::dmat3& magnitude = instance.magnitude;
    const glm::dvec3 mapping = magnitude * (glm::abs(segment.from) + glm::abs(segment.to)) + 2.0 * glm::abs(instance.shift);
    const glm::dvec3 reach = glm::abs(from) + glm::abs(to) + instance.largest;
    return {from, to, instance.slack + 2.0 * (magnitude * segment.error) + 32 * unit * (mapping + reach)};
}

} // namespace shadowbench::groundtruth::geometry
