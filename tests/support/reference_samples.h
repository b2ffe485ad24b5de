// References that no oracle made, for the tests of files and caches.
#pragma once

#include "groundtruth/contract/reference.h"

#include <limits>

namespace shadowbench::groundtruth {

inline const std::string someKey = "0123456789abcdef0123456789abcdef";
inline const std::string otherKey = "0123456789abcdef0123456789abcdee";
inline const std::string someSources = "fedcba987654", otherSources = "fedcba987655";

/// Numbers of every kind: infinities, subnormals, negative zero, the last id.
inline Reference sample(const std::string& key, float first = 0.25F) {
    constexpr int width = 5, height = 3;
    Reference r{{width, height, first},
                {width, height, 1e-41F},
                {width, height},
                {width, height, 7},
                {width, height},
                {width, height, std::numeric_limits<float>::infinity()},
                {}};
    r.surface(4, 2) = Surface::OnEdge;
    r.id(0, 1) = std::numeric_limits<std::uint32_t>::max();
    r.position(3, 1) = {-0.0F, 1.0F / 3.0F, -1e30F};
    r.edgeDistance(1, 0) = 0.125F;
    r.provenance = {"povray", key, 1024, {{"povray", "3.7.0.10.unofficial"}}, 1.0 / 3.0, {{"scale", 1024}}, someSources};
    return r;
}

} // namespace shadowbench::groundtruth
