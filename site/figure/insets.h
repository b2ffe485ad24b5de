// Which parts of an image a figure shows enlarged.
#pragma once

#include "base/image.h"
#include "harness/cells/kept_images.h"

#include <string>
#include <vector>

namespace shadowbench::site {

/// Pixels x … x + width − 1, y … y + height − 1.
struct Inset {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const Inset&, const Inset&) = default;
};

/// "120,80,51,51" as x, y, width and height in pixels; throws BadInput for what is none.
Inset insetOf(const std::string& text);
std::string textOf(const Inset& inset);

/// Where the images differ most from each other, of one image from the truth: of all parts of a fifth of the width and an
/// eighth of the height the one with the largest sum over receivers, the first in reading order. In the middle where nothing
/// differs.
Inset mostTelling(const std::vector<Image<float>>& images, const KeptTruth& truth);

/// The part, each pixel `times` as wide and high. It must lie within the image.
Image<glm::vec3> enlarged(const Image<glm::vec3>& picture, const Inset& part, int times);

} // namespace shadowbench::site
