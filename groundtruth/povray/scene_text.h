// What the scene texts of all kinds of light share.
#pragma once

#include "scene/snapshot.h"

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <string>
#include <utility>

namespace shadowbench::groundtruth::povray {

using Text = fmt::memory_buffer;

/// Of the blue channel: the light has the other half.
inline constexpr double hitMask = 0.5;

template <typename... Arguments>
void add(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

/// Round-trip decimal form. Throws BadInput unless the numbers are finite.
std::string vector(const glm::dvec3& v);

/// `largestScale`, halved until POV-Ray can hold the scene and lights whose coordinates are at most `lights`.
double scaleFor(const Snapshot& snapshot, double lights, double largestScale);

/// How surfaces are written.
struct Surfaces {
    double scale;          // POV-Ray units per world unit
    double brilliance;     // the power of the cosine in the diffuse term
    bool doubleIlluminate; // a light counts whichever side of the surface it is on
};

/// Camera and objects. Blue of what is hit has hitMask.
void addScene(Text& text, const Snapshot& snapshot, glm::ivec2 size, const Surfaces& surfaces);

} // namespace shadowbench::groundtruth::povray
