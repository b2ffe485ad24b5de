// A convex region of space as seen by box trees: where triangles can lie that hide a light from a point. It only proposes:
// every test errs on the side of "meets".
#pragma once

#include "groundtruth/cgal/geometry/bvh.h"

#include <array>
#include <cassert>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace shadowbench::groundtruth::geometry {

/// The points X with normal · X + offset ≥ −slack.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
    double slack; // how far the plane may be from the meant one, times the normal's length, at any point of the scene
};

/// The intersection of at most six half-spaces.
class Shaft {
public:
    void add(const HalfSpace& space) {
        assert(count_ < spaces_.size());
        spaces_[count_++] = space;
    }

    [[nodiscard]] bool meets(const FloatBox& box) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const HalfSpace& space = spaces_[i];
            const glm::dvec3 most = glm::max(space.normal * glm::dvec3(box.low), space.normal * glm::dvec3(box.high));
            if (most.x + most.y + most.z + space.offset < -space.slack) return false;
        }
        return true;
    }

    /// The same of four boxes at a time.
    [[nodiscard]] std::array<bool, 4> meets(const FourBoxes& boxes) const {
        using Doubles = double __attribute__((vector_size(32)));
        std::array<Doubles, 3> low, high;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = __builtin_convertvector(boxes.low[axis], Doubles);
            high[axis] = __builtin_convertvector(boxes.high[axis], Doubles);
        }
        std::array<bool, 4> result{true, true, true, true};
        for (std::size_t i = 0; i < count_; ++i) {
            const HalfSpace& space = spaces_[i];
            std::array<Doubles, 3> most;
            for (int axis = 0; axis < 3; ++axis)
                most[axis] = space.normal[axis] * (space.normal[axis] > 0 ? high : low)[axis];
            const Doubles sum = most[0] + most[1] + most[2] + space.offset;
            for (std::size_t box = 0; box < 4; ++box) result[box] &= !(sum[box] < -space.slack);
        }
        return result;
    }

    /// The same region in the space of an object whose mesh lies within `bounds`.
    [[nodiscard]] Shaft inObject(const glm::dmat4& world, const FloatBox& bounds) const {
        constexpr double rounding = 64 * 0x1p-53; // of worldVertex, the products here and those of `meets`, rounded up
        const glm::dvec3 largest = glm::max(glm::abs(glm::dvec3(bounds.low)), glm::abs(glm::dvec3(bounds.high)));
        const glm::dvec3 shift(world[3]);
        Shaft result;
        for (std::size_t i = 0; i < count_; ++i) {
            const HalfSpace& space = spaces_[i];
            glm::dvec3 normal(0);
            double reach = glm::dot(glm::abs(space.normal), glm::abs(shift)) + std::abs(space.offset);
            for (int axis = 0; axis < 3; ++axis) {
                normal[axis] = glm::dot(space.normal, glm::dvec3(world[axis]));
                reach += glm::dot(glm::abs(space.normal), glm::abs(glm::dvec3(world[axis]))) * largest[axis];
            }
            result.add({normal, glm::dot(space.normal, shift) + space.offset, space.slack + rounding * reach});
        }
        return result;
    }

private:
    std::array<HalfSpace, 6> spaces_;
    std::size_t count_ = 0;
};

} // namespace shadowbench::groundtruth::geometry
