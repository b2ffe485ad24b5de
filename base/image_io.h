// Our own image files. Every write is whole or not at all. Those of other people are decoded in a child:
// base/confined/image_reader.h.
#pragma once

#include "base/image.h"

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {

/// A named channel of a multi-channel EXR.
using Channel = std::pair<std::string, const Image<float>*>;

/// 32-bit float EXR, ZIP-compressed; all channels of one size; same channels, same bytes. Throws InternalError naming the
/// file when it cannot be written.
void writeExr(const std::filesystem::path& file, const std::vector<Channel>& channels);

/// 8-bit grey PNG of values in [0, 1] (clamped), linear: 0.5 becomes 128.
void writePng(const std::filesystem::path& file, const Image<float>& grey);

/// 8-bit RGB PNG of values in [0, 1] (clamped), linear.
void writePng(const std::filesystem::path& file, const Image<glm::vec3>& colour);

/// What a file says of its image before its pixels are read.
struct ImageHeader {
    std::string format; // "openexr", "png", "pnm" (PFM is one), "jpeg" …
    int width = 0, height = 0;
    std::vector<std::string> channels; // by index
    int alpha = -1;                    // index of that channel; −1: there is none
    int bits = 0;                      // of a number
    bool floats = false;               // else integers
    bool whole = true;                 // one flat picture from (0, 0) on; no window of a larger one, no depth samples
};

/// Reads one channel (by index) of an EXR, PNG or PFM as linear values; integers are divided by their maximum, no gamma
/// applied. Throws BadInput for a missing or unreadable file and for a channel that is not there.
Image<float> readChannel(const std::filesystem::path& file, int channel);

/// The same by the channel's name: OpenEXR keeps channels sorted by name, so that the order of writing says nothing about
/// the index.
Image<float> readChannel(const std::filesystem::path& file, const std::string& channel);

} // namespace shadowbench
