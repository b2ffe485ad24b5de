// Visibility textures (dissertation 5.1.3): in which order the fragments of an instance appear. No GL.
#pragma once

#include "base/image.h"

#include <cstdint>
#include <string_view>

namespace shadowbench::techniques {

inline constexpr int visibilityTextureSide = 64; // texels; the dissertation's (5.2)

/// A fragment is seen while its texel's value / 255 ≤ τ (eq. 5.1). Values are 1 … 255, so that nothing is seen at τ = 0 and
/// everything at τ = 1. Patterns: "noise" (uniform), "checker" (8 × 8 cells of two values, a half of the fragments at a
/// time), "centre-out" (from the texture's centre outward). Noise and centre-out show the share τ of all texels to within a
/// step of 1/255.
Image<std::uint8_t> visibilityTexture(std::string_view pattern);

} // namespace shadowbench::techniques
