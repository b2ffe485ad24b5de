#include "base/image_input.h"

#include "base/error.h"
#include "base/image_formats.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench {
namespace {

using namespace std::string_view_literals;

struct Format {
    std::string_view beginning, name;
    ImageHeader (*headerOf)(std::string_view) = nullptr; // of a format that is read
    Image<float> (*channelOf)(std::string_view, int) = nullptr;
};

constexpr std::array<Format, 17> formats{{{"\x76\x2f\x31\x01", "openexr", exr::headerOf, exr::channelOf},
                                          {"\x89PNG\r\n\x1a\n", "png", png::headerOf, png::channelOf},
                                          {"PF", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"Pf", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P1", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P2", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P3", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P4", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P5", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"P6", "pnm", pnm::headerOf, pnm::channelOf},
                                          {"\xff\xd8\xff", "jpeg"},
                                          {"#?", "hdr"},
                                          {"GIF8", "gif"},
                                          {"RIFF", "webp"},
                                          {"BM", "bmp"},
                                          {"II*\0"sv, "tiff"},
                                          {"MM\0*"sv, "tiff"}}};

const Format& formatOf(std::string_view bytes) {
    const auto* const format =
        std::ranges::find_if(formats, [&](const Format& f) { return bytes.starts_with(f.beginning); });
    if (format == formats.end()) throw BadInput(bytes.empty() ? "it is empty" : "it is no EXR, PNG or PFM file");
    return *format;
}

} // namespace

ImageHeader headerOf(std::string_view bytes) {
    const Format& format = formatOf(bytes);
    return format.headerOf != nullptr ? format.headerOf(bytes)
                                      : ImageHeader{.format = std::string(format.name), .channels = {}};
}

Image<float> channelOf(std::string_view bytes, const ImageHeader& header, int channel) {
    if (channel < 0 || static_cast<std::size_t>(channel) >= header.channels.size())
        throw BadInput(fmt::format("it has {} channels, counted from 0, and no {}", header.channels.size(), channel));
    return formatOf(bytes).channelOf(bytes, channel);
}

} // namespace shadowbench
