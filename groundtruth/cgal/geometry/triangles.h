// The scene's triangles behind two levels of trees: one per mesh in object space, one over the instances in the world.
#pragma once

#include "groundtruth/cgal/geometry/bvh.h"
#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/shaft.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <deque>
#include <glm/mat3x3.hpp>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace shadowbench::groundtruth::geometry {

/// The double-precision image of a float position, operations in this order, each rounded to nearest.
inline glm::dvec3 worldVertex(const glm::dmat4& world, const glm::vec3& position) {
    const glm::dvec3 p(position);
    glm::dvec3 result(0);
    for (int row = 0; row < 3; ++row)
        result[row] = ((world[0][row] * p.x + world[1][row] * p.y) + world[2][row] * p.z) + world[3][row];
    return result;
}

/// Names a triangle of the scene.
struct TriangleName {
    std::uint32_t instance = 0; // index of SceneTriangles::instance
    std::uint32_t triangle = 0; // index of Mesh::triangles
    friend bool operator==(const TriangleName&, const TriangleName&) = default;
};

/// An instance and the map back to object space. `slack` bounds, per axis, the distance between a mesh position and
/// toObject · worldVertex + shift. `box` contains all world vertices.
struct TriangleInstance {
    std::shared_ptr<const Mesh> mesh;
    std::size_t tree;
    glm::dmat4 world;
    std::uint32_t id;
    glm::dmat3 toObject;
    glm::dmat3 magnitude; // |toObject|
    glm::dvec3 largest;   // |coordinate| of a mesh position, by axis
    glm::dvec3 shift;
    glm::dvec3 slack;
    FloatBox box;
};

/// A segment whose every point is known to within `error` per axis.
struct ApproximateSegment {
    glm::dvec3 from, to;
    glm::dvec3 error;
};

/// Const use is thread-safe.
class SceneTriangles {
public:
    explicit SceneTriangles(const Snapshot& snapshot);

    [[nodiscard]] const std::vector<TriangleInstance>& instances() const { return instances_; }
    [[nodiscard]] std::size_t meshes() const { return trees_.size(); } // distinct ones: TriangleInstance::tree is below
    [[nodiscard]] std::uint32_t instanceOf(std::uint32_t id) const;    // index of the placement with that surface id
    [[nodiscard]] Triangle triangle(TriangleName name) const;
    [[nodiscard]] double reachFrom(const glm::dvec3& point) const; // all of the scene lies nearer to the point than this

    /// Calls `visit(name, last)` for every triangle that the segment may meet, roughly front to back, until it returns true;
    /// `visit` may lower `last`, the parameter in [0, 1] beyond which nothing is wanted. True if stopped.
    template <typename Visit>
    bool visit(const ApproximateSegment& segment, Visit&& visit) const {
        if (top_.empty()) return false;
        PaddedSegment top = padded(segment);
        return top_.visit(top, [&](std::uint32_t i) {
            const TriangleInstance& instance = instances_[i];
            if (!mayMeet(top, instance.box)) return false; // of several in a leaf
            PaddedSegment local = padded(segment, instance);
            local.last = top.last;
            const bool stopped = tree(instance.tree).visit(local, [&](std::uint32_t index) {
                return visit(TriangleName{i, index}, local.last);
            });
            top.last = local.last;
            return stopped;
        });
    }

    /// Calls `visit(name)` for every triangle that may meet the shaft, all of one instance in a row.
    template <typename Visit>
    void visitShaft(const Shaft& shaft, Visit&& visit) const {
        top_.visitBoxes(shaft, [&](std::uint32_t i) {
            const Bvh& triangles = tree(instances_[i].tree);
            triangles.visitBoxes(shaft.inObject(instances_[i].world, triangles.bounds()), [&](std::uint32_t index) {
                visit(TriangleName{i, index});
            });
        });
    }

private:
    [[nodiscard]] PaddedSegment padded(const ApproximateSegment& segment) const;
    [[nodiscard]] PaddedSegment padded(const ApproximateSegment& segment, const TriangleInstance& instance) const;

    /// The triangles of a distinct mesh. The tree is built when a segment first comes near.
    struct MeshTree {
        std::shared_ptr<const Mesh> mesh;
        FloatBox box;
        std::once_flag built;
        Bvh tree;
    };
    const Bvh& tree(std::size_t index) const;

    mutable std::deque<MeshTree> trees_;
    std::vector<TriangleInstance> instances_;
    std::unordered_map<std::uint32_t, std::uint32_t> indexOf_; // surface id → instance
    Bvh top_;
};

} // namespace shadowbench::groundtruth::geometry
