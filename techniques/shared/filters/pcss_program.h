// The uniforms of shared/filters/blocker_search.glsl and shared/filters/pcss.glsl, set in one place.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/shared/maps/linearised_map.h"

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// Numbers of taps of blocker search and filter: "16+16", "32+32" (Scherzer 4.2), "25+49" (Zápotocký: 5×5 and 7×7 grids).
struct PcssTaps {
    int search, filter;
    bool grid;

    static PcssTaps parse(const std::string& text);
    [[nodiscard]] gl::Defines defines() const;
};

/// Light size and map geometry.
void setBlockerSearch(gl::Program& program, const Light& light, const LightView& view, const LinearisedMap& map,
                      bool followPlane);

/// The same and tap positions: Poisson taps over the light's own shape, or grids.
void setPcss(gl::Program& program, const PcssTaps& taps, const Light& light, const LightView& view, const LinearisedMap& map,
             bool followPlane);

} // namespace shadowbench::techniques
