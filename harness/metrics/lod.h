// Metrics of level-of-detail pictures, as pure functions. Colours have 8 bits a channel; differences are in [0, 1]. Images
// of one call have the same size; otherwise InternalError.
#pragma once

#include "base/image.h"

#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_uint3_sized.hpp>

namespace shadowbench::metrics {

using ColourImage = Image<glm::u8vec3>;

/// Mean over pixels and channels of |a − b|.
double meanChange(const ColourImage& a, const ColourImage& b);

/// Mean over pixels and channels of (a − b)².
double meanSquare(const ColourImage& a, const ColourImage& b);

/// Pixels of the largest 4-connected region that differs by more than 30/255 in some channel.
std::size_t largestChangedRegion(const ColourImage& a, const ColourImage& b);

/// Sum over the pixels of `mask` (≠ 0) of the mean distance of a channel to its median over the 3 × 3 pixels around (fewer
/// at the border): stipple is far from it, a straight edge is not.
double speckle(const ColourImage& image, const Image<unsigned>& mask);

} // namespace shadowbench::metrics
