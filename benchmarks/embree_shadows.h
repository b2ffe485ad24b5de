// Shadow rays by Embree 3 in single precision: the speed anchor of the exact oracles, not truth.
#pragma once

#include "groundtruth/contract/reference.h"

#include <memory>

namespace shadowbench::benchmarks {

/// A snapshot in Embree: one triangle geometry per placement, world positions rounded to float, robust scene, default build
/// quality.
class EmbreeShadows {
public:
    EmbreeShadows(const Snapshot& snapshot, int threads); // builds; InternalError with Embree's message
    ~EmbreeShadows();
    EmbreeShadows(const EmbreeShadows&) = delete;
    EmbreeShadows& operator=(const EmbreeShadows&) = delete;

    /// Visibility (1 or 0) of the point light at the receivers of `primary`, 0 elsewhere. Rays run from the receiver point
    /// in float to the light, one by one (rtcOccluded1), from the share `tnear` of the way on: above 0, so that a surface
    /// does not meet itself.
    [[nodiscard]] Image<float> visibility(const groundtruth::PrimaryHits& primary, const glm::dvec3& light,
                                          float tnear) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
    int threads_;
};

} // namespace shadowbench::benchmarks
