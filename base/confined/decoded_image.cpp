#include "base/confined/decoded_image.h"

#include "base/error.h"
#include "base/limits.h"

#include <array>
#include <fmt/format.h>
#include <string_view>

namespace shadowbench {
namespace {

/// How files of a format begin.
struct Beginning {
    std::string_view bytes, format;
    bool isRead;
};

constexpr std::array<Beginning, 15> beginnings{{{"\x76\x2f\x31\x01", "openexr", true},
                                                {"\x89PNG\r\n\x1a\n", "png", true},
                                                {"PF", "pnm", true},
                                                {"Pf", "pnm", true},
                                                {"P1", "pnm", true},
                                                {"P2", "pnm", true},
                                                {"P3", "pnm", true},
                                                {"P4", "pnm", true},
                                                {"P5", "pnm", true},
                                                {"P6", "pnm", true},
                                                {"\xff\xd8\xff", "jpeg", false},
                                                {"#?", "hdr", false},
                                                {"GIF8", "gif", false},
                                                {"RIFF", "webp", false},
                                                {"BM", "bmp", false}}};

const Beginning& beginningOf(std::string_view bytes) {
    for (const Beginning& beginning : beginnings)
        if (bytes.starts_with(beginning.bytes)) return beginning;
    static constexpr Beginning tiff{"", "tiff", false};
    using namespace std::string_view_literals;
    if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return tiff;
    throw BadInput(bytes.empty() ? "it is empty" : "it is no EXR, PNG or PFM file");
}

OIIO::cspan<unsigned char> spanOf(const std::string& bytes) {
    return {reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<std::ptrdiff_t>(bytes.size())};
}

} // namespace

DecodedImage::DecodedImage(std::string bytes) : bytes_(std::move(bytes)), memory_(spanOf(bytes_)) {
    const Beginning& beginning = beginningOf(bytes_);
    header_.format = beginning.format;
    if (!beginning.isRead) return;
    OIIO::attribute("exr_threads", -1); // all in the one thread that there is
    open();
    header_ = headerOf(*input_);
}

void DecodedImage::open() {
    memory_.seek(0);
    input_ = OIIO::ImageInput::create(header_.format);
    if (!input_ || !input_->set_ioproxy(&memory_)) throw BadInput("OpenImageIO cannot read its format from memory");
    OIIO::ImageSpec found;
    // The name is only for messages: the bytes come from memory_.
    if (!input_->open("image." + header_.format, found, asStored())) throw BadInput(inOneLine(input_->geterror()));
    isRead_ = false;
}

Image<float> DecodedImage::channel(int index) {
    const auto count = static_cast<int>(header_.channels.size());
    if (index < 0 || index >= count)
        throw BadInput(fmt::format("it has {} channels, counted from 0, and no {}", count, index));
    const auto pixels = static_cast<std::uint64_t>(header_.width) * static_cast<std::uint64_t>(header_.height);
    if (header_.width < 1 || header_.height < 1 || pixels > limitOf(Limit::Pixels))
        throw BadInput(fmt::format("it has {} × {} pixels, {}", header_.width, header_.height, beyond(Limit::Pixels)));
    if (isRead_) open(); // for an earlier row OpenImageIO would open a file of that name, which is none
    isRead_ = true;
    return pixelsOf(*input_, index);
}

} // namespace shadowbench
