// What filtered/deep-sm/transmittance.glsl computes (Lokovic and Veach 2000).
#pragma once

#include "techniques/filtered/deep-sm/transmittance.h"

#include <algorithm>
#include <span>

namespace shadowbench::models {

/// Share of light that passes everything nearer than `depth`: at a jump, its upper end.
inline double transmittanceAt(std::span<const techniques::TransmittanceNode> function, double depth) {
    const auto behind = std::find_if(function.begin(), function.end(), [&](const techniques::TransmittanceNode& node) {
        return depth <= static_cast<double>(node.depth);
    });
    if (behind == function.begin()) return 1;
    const techniques::TransmittanceNode& a = *(behind - 1);
    if (behind == function.end()) return a.transmittance;
    const double share = (depth - static_cast<double>(a.depth)) / static_cast<double>(behind->depth - a.depth);
    return static_cast<double>(a.transmittance) + share * static_cast<double>(behind->transmittance - a.transmittance);
}

} // namespace shadowbench::models
