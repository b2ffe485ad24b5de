#include "base/confined/decoded_image.h"

#include "base/error.h"
#include "base/image_input.h"
#include "base/limits.h"

#include <fmt/format.h>

namespace shadowbench {

DecodedImage::DecodedImage(std::string bytes) : bytes_(std::move(bytes)), header_(headerOf(bytes_)) {}

Image<float> DecodedImage::channel(int index) const {
    const auto pixels = static_cast<std::uint64_t>(header_.width) * static_cast<std::uint64_t>(header_.height);
    if (pixels > limitOf(Limit::Pixels))
        throw BadInput(fmt::format("it has {} × {} pixels, {}", header_.width, header_.height, beyond(Limit::Pixels)));
    return channelOf(bytes_, header_, index);
}

} // namespace shadowbench
