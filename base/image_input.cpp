#include "base/image_input.h"

#include "base/error.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace shadowbench {

OIIO::ImageSpec asStored() {
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    return wanted;
}

ImageHeader headerOf(const OIIO::ImageInput& input) {
    const OIIO::ImageSpec& spec = input.spec();
    const bool window =
        spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width || spec.height != spec.full_height;
    return {.format = input.format_name(),
            .width = spec.width,
            .height = spec.height,
            .channels = spec.channelnames,
            .alpha = spec.alpha_channel,
            .bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * spec.format.size())),
            .floats = spec.format.is_floating_point(),
            .whole = !window && !spec.deep && spec.depth <= 1};
}

namespace {

/// For one of a PNG's or PNM's channels OpenImageIO would make a pool of threads, which a confined reader cannot; a row with
/// all channels it reads in the thread that asks.
Image<float> pixelsByRows(OIIO::ImageInput& input, int channel) {
    const OIIO::ImageSpec& spec = input.spec();
    Image<float> image(spec.width, spec.height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> row(static_cast<std::size_t>(spec.width) * channels);
    for (int y = 0; y < spec.height; ++y) {
        if (!input.read_scanline(spec.y + y, 0, OIIO::TypeDesc::FLOAT, row.data()))
            throw BadInput(inOneLine(input.geterror()));
        for (int x = 0; x < spec.width; ++x)
            image(x, y) = row[static_cast<std::size_t>(x) * channels + static_cast<std::size_t>(channel)];
    }
    return image;
}

} // namespace

Image<float> pixelsOf(OIIO::ImageInput& input, int channel) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.nchannels > 1 && std::string_view(input.format_name()) != "openexr") return pixelsByRows(input, channel);
    Image<float> image(spec.width, spec.height);
    if (!input.read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, image.data()))
        throw BadInput(inOneLine(input.geterror()));
    return image;
}

std::string inOneLine(std::string reason) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    while (reason.ends_with(' ')) reason.pop_back();
    return reason.empty() ? "it is damaged" : reason;
}

} // namespace shadowbench
