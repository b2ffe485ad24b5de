// OpenImageIO's images as ours. Only sources of this folder and of base/confined/ include this: it brings OpenImageIO.
#pragma once

#include "base/image_io.h"

#include <OpenImageIO/imageio.h>
#include <string>

namespace shadowbench {

/// Colours as stored, not multiplied by alpha.
OIIO::ImageSpec asStored();

ImageHeader headerOf(const OIIO::ImageInput& input);

/// Channel `channel` as linear values. Throws BadInput with what OpenImageIO says, without a file's name.
Image<float> pixelsOf(OIIO::ImageInput& input, int channel);

/// What OpenImageIO says went wrong, in one line.
std::string inOneLine(std::string reason);

} // namespace shadowbench
