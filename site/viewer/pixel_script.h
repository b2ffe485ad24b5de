// Float images as scripts: the one kind of data that a page which was opened from a file may read.
#pragma once

#include "base/image.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench::site {

/// float32 values as a page unpacks them, bit for bit: the lowest bytes of all values, then the next …, deflated (zlib), in
/// base64. Same values, same text.
std::string packed(const std::vector<float>& values);

/// A script that hands the viewer the channels of `name`, its own address without ".js".
std::string pixelScript(std::string_view name, const std::vector<std::pair<std::string, std::vector<float>>>& channels);

std::vector<float> valuesOf(const Image<float>& image);

} // namespace shadowbench::site
