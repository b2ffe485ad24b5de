// A square map of transmittance functions, in one list for the GPU.
#pragma once

#include "base/image.h"
#include "techniques/filtered/deep-sm/transmittance.h"

#include <cstdint>
#include <vector>

namespace shadowbench::techniques {

struct DeepTexture {
    std::vector<std::uint32_t> first; // node with which texel x + y · side begins, row 0 at the bottom; one more at the end
    Transmittance nodes;
};

/// One function a texel from the samples × samples depths in it (1: nothing hit, row 0 at the top), compressed within
/// `error`. Replaces what `deep` holds. Throws InternalError when the image's side is no multiple of `samples`.
void buildDeepTexture(const Image<float>& depths, int samples, float error, DeepTexture& deep);

} // namespace shadowbench::techniques
