// What a shadow's error is caused by (docs/metrics.md, "Why it is wrong").
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace shadowbench::causes {

/// In the order in which experiments remove them; Method is what all of them leave.
enum class Cause : std::uint8_t {
    Geometry,
    Outside,
    Leak,
    Fusion,
    History,
    Filter,
    SmallBias,
    Undersampled,
    LargeBias,
    FewSamples,
    Method,
};

struct CauseWords {
    Cause cause;
    std::string_view name;
    std::string_view colourName;
    glm::vec3 colour; // in pictures
};

/// All of them, in that order.
std::span<const CauseWords> allCauses();

const CauseWords& words(Cause cause);
inline std::string_view name(Cause cause) { return words(cause).name; }

} // namespace shadowbench::causes
