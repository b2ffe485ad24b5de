// What maps that are kept from frame to frame depend on.
#pragma once

#include "techniques/contract/technique.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace shadowbench::techniques {

/// Light, casters and seed of a frame; its camera and time are none of them.
struct Surroundings {
    explicit Surroundings(const Frame& frame) : light(frame.snapshot.light), seed(frame.seed) {
        for (const Batch& batch : frame.snapshot.batches)
            for (const Placement& placement : batch.placements) casters.emplace_back(batch.mesh, placement.world);
    }
    friend bool operator==(const Surroundings&, const Surroundings&) = default;

    Light light;
    std::uint32_t seed;
    std::vector<std::pair<std::shared_ptr<const Mesh>, glm::dmat4>> casters;
};

} // namespace shadowbench::techniques
