// The image formats: each is read from memory and written into it. What reads throws BadInput with the reason, without a
// file's name; it takes no more memory than the image and its rows need. A header costs little, a channel the whole file.
#pragma once

#include "base/image_io.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

namespace exr {

/// Channels come layer by layer, within each R, G, B, Y, A and Z first and then the others by name. Of a file of several
/// parts the first counts.
ImageHeader headerOf(std::string_view bytes);
Image<float> channelOf(std::string_view bytes, int channel);

/// 32-bit float, ZIP-compressed; all channels of one size.
std::string encoded(const std::vector<Channel>& channels);

} // namespace exr

namespace png {

/// Grey is "Y"; palettes are colours, transparent colours an alpha channel, and fewer bits than eight are spread to eight.
ImageHeader headerOf(std::string_view bytes);
Image<float> channelOf(std::string_view bytes, int channel);

/// 8 bits a number; `channels` (1: grey, 3: RGB, 4: RGBA) of each pixel side by side.
std::string encoded(int width, int height, int channels, const std::vector<std::uint8_t>& pixels);

} // namespace png

/// The formats P1 to P6 (Netpbm), and the floats of PF and Pf (PFM).
namespace pnm {

ImageHeader headerOf(std::string_view bytes);
Image<float> channelOf(std::string_view bytes, int channel);

} // namespace pnm

} // namespace shadowbench
