#include "base/confined/image_reader.h"

#include "base/confined/decoded_image.h"
#include "base/error.h"
#include "base/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace shadowbench {
namespace {

constexpr std::uint64_t mostChannels = 4096;
constexpr std::size_t longestName = 1024; // of a format or a channel, bytes
constexpr std::uint64_t longestSide = 1 << 30, mostBits = 64;

// ---- in the child
// ---------------------------------------------------------------------------------------------------------------

void put(Wire& wire, const ImageHeader& header) {
    wire.put(header.format);
    for (const int number :
         {header.width, header.height, header.alpha + 1, header.bits, int{header.floats}, int{header.whole}})
        wire.put(static_cast<std::uint64_t>(std::max(0, number)));
    wire.put(std::uint64_t{header.channels.size()});
    for (const std::string& channel : header.channels) wire.put(std::string_view(channel).substr(0, longestName));
}

void decode(ForeignWork& work) {
    DecodedImage image(contentOf(work.files().front()));
    put(work.answer(), image.header());
    while (const auto asked = work.question(mostChannels)) {
        const Image<float> channel = image.channel(static_cast<int>(*asked));
        work.answer().put(std::span<const float>(channel.data(), channel.size()));
    }
}

const ForeignReader decoder("image", decode);

// ---- in the parent
// --------------------------------------------------------------------------------------------------------------

std::vector<OpenedFile> only(const std::filesystem::path& file) {
    std::vector<OpenedFile> files;
    files.push_back(openRegular(file, "cannot read image"));
    return files;
}

} // namespace

ImageHeader receivedHeader(ReaderChild& child) {
    child.awaitAnswer();
    ImageHeader header;
    header.format = child.text(longestName);
    header.width = static_cast<int>(child.number(longestSide, "pixels wide"));
    header.height = static_cast<int>(child.number(longestSide, "pixels high"));
    header.alpha = static_cast<int>(child.number(mostChannels, "channels")) - 1;
    header.bits = static_cast<int>(child.number(mostBits, "bits"));
    header.floats = child.number(1, "as a flag") != 0;
    header.whole = child.number(1, "as a flag") != 0;
    for (std::uint64_t left = child.number(mostChannels, "channels"); left > 0; --left)
        header.channels.push_back(child.text(longestName));
    if (header.alpha >= static_cast<int>(header.channels.size())) child.refuse("its alpha channel is none of its channels");
    return header;
}

ImageReader::ImageReader(const std::filesystem::path& file)
    : file_(file), child_(decoder, fmt::format("cannot read image {}", file.string()), only(file)),
      header_(receivedHeader(child_)) {}

Image<float> ImageReader::channel(int index) {
    const std::uint64_t most = limitOf(Limit::Pixels);
    const auto pixels = static_cast<std::uint64_t>(header_.width) * static_cast<std::uint64_t>(header_.height);
    if (index < 0 || static_cast<std::size_t>(index) >= header_.channels.size())
        child_.refuse(fmt::format("it has {} channels, counted from 0, and no {}", header_.channels.size(), index));
    if (pixels > most)
        child_.refuse(fmt::format("it has {} × {} pixels, {}", header_.width, header_.height, beyond(Limit::Pixels)));
    child_.ask(static_cast<std::uint64_t>(index));
    child_.awaitAnswer();
    Image<float> image(header_.width, header_.height);
    child_.fill(std::span<float>(image.data(), image.size()));
    return image;
}

Image<float> ImageReader::channel(const std::string& name) {
    const auto found = std::ranges::find(header_.channels, name);
    if (found == header_.channels.end())
        throw BadInput(fmt::format("cannot read channel \"{}\" of image {}: it has {}", name, file_.string(),
                                   fmt::join(header_.channels, ", ")));
    return channel(static_cast<int>(found - header_.channels.begin()));
}

} // namespace shadowbench
