// Images in memory, of whatever format they are.
#pragma once

#include "base/image_io.h"

#include <string_view>

namespace shadowbench {

/// Reads the header of an EXR, PNG, PFM or other PNM; the format is chosen by the first bytes. Of another format that is
/// known: its name and no more. Throws BadInput with the reason, without a file's name.
ImageHeader headerOf(std::string_view bytes);

/// A channel of an image with that header, as linear values. Throws BadInput as above, and where there is no such channel.
Image<float> channelOf(std::string_view bytes, const ImageHeader& header, int channel);

} // namespace shadowbench
