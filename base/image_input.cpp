#include "base/image_input.h"

#include "base/error.h"

#include <algorithm>

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

Image<float> pixelsOf(OIIO::ImageInput& input, int channel) {
    Image<float> image(input.spec().width, input.spec().height);
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
