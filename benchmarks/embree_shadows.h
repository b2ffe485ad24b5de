// Shadow rays by Embree 3 in single precision: the speed anchor of the exact oracles, not truth.
#pragma once

#include "groundtruth/contract/reference.h"

#include <functional>
#include <memory>
#include <span>

namespace shadowbench::benchmarks {

/// A snapshot in Embree: one triangle geometry per placement, world positions rounded to float, robust scene, default build
/// quality.
class EmbreeShadows {
public:
    /// Builds; InternalError with Embree's message. `filters`: for `visible`.
    EmbreeShadows(const Snapshot& snapshot, int threads, bool filters = false);
    ~EmbreeShadows();
    EmbreeShadows(const EmbreeShadows&) = delete;
    EmbreeShadows& operator=(const EmbreeShadows&) = delete;

    /// Visibility (1 or 0) of the light, a homogeneous position, at the receivers of `primary`, 0 elsewhere. Rays run from
    /// the receiver point in float to the light, or as far as the scene reaches, one by one (rtcOccluded1), from the share
    /// `tnear` of the way on: above 0, so that a surface does not meet itself.
    [[nodiscard]] Image<float> visibility(const groundtruth::PrimaryHits& primary, const glm::dvec4& light,
                                          float tnear) const;

    /// Names a triangle by the number of its placement, in the order of the snapshot, and its number in the mesh.
    using Ignored = std::function<bool(unsigned, unsigned)>;

    /// `result[i]` = 1 where nothing but what is ignored lies between `from` and `lights[i]`, else 0.
    void visible(const glm::dvec3& from, std::span<const glm::dvec3> lights, const Ignored& ignored,
                 std::span<char> result) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
    int threads_;
    double reach_; // from one end of the scene to the other
};

} // namespace shadowbench::benchmarks
