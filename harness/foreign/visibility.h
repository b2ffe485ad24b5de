// From files to visibility.
#pragma once

#include "harness/foreign/foreign_image.h"

#include <cstdint>

namespace shadowbench::foreign {

/// 1 at the pixels that are scored.
using Pixels = Image<std::uint8_t>;

/// One frame's visibility, as it was written; of a quotient clamped to [0, 1].
struct Visibility {
    Image<float> v;
    Pixels unknown; // 1 at scored pixels where a quotient's divisor is too small to say anything; empty: nowhere
};

/// The grey of `image`. Throws BadInput where its channels differ or it is transparent at a scored pixel.
Image<float> greyOf(const ForeignImage& image, const Pixels& scored);

/// Throws BadInput, with `file`, how many and how far, for scored pixels outside [0, 1] by more than the rounding of a
/// 16-bit float.
void requireShares(const Image<float>& v, const Pixels& scored, const std::filesystem::path& file);

/// (image − unlit) / (lit − unlit), each summed over the channels; `unlit` may be null: black. Unknown where the divisor is
/// below a ten-thousandth of its largest, or below sixteen steps of an integer file. Throws BadInput when that is so at more
/// than a thousandth of the scored pixels, as many as may see another surface, and when more than a hundredth of the others
/// lie outside [−0.1, 1.1].
Visibility quotient(const ForeignImage& image, const ForeignImage& lit, const ForeignImage* unlit, const Pixels& scored);

/// Reads one frame. Throws as all above and readForeign do.
Visibility visibilityOf(const FrameFiles& files, const Reading& reading, const Pixels& scored,
                        std::vector<std::string>& warnings);

} // namespace shadowbench::foreign
