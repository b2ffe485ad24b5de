#include "harness/foreign/foreign_image.h"

#include "base/confined/image_reader.h"
#include "base/error.h"
#include "base/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <optional>

namespace shadowbench::foreign {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw BadInput(fmt::format("image {} {}", file.string(), why));
}

/// The fourth part of a PNG's header says how its numbers are colours; 3: by a palette.
bool hasPalette(const ImageHeader& header, const fs::path& file) {
    constexpr std::size_t place = 25;
    std::array<char, place + 1> start{};
    std::ifstream stream(file, std::ios::binary);
    return header.format == "png" && stream.read(start.data(), start.size()) && start[place] == 3;
}

/// Opens `file`, once it is there.
ImageReader opened(const fs::path& file) {
    const fs::file_status status = fs::status(file);
    if (!fs::exists(status)) refuse(file, "is not there; check its name, and that the renderer has written it");
    if (fs::is_directory(status)) refuse(file, "is a folder: name the files in it");
    return ImageReader(file);
}

void requireFitting(const ImageHeader& header, const fs::path& file, glm::ivec2 size) {
    if (header.format != "openexr" && header.format != "png" && header.format != "pnm")
        refuse(file, fmt::format("is of the format {}: give EXR, PNG or PFM, which keep what was rendered", header.format));
    const glm::ivec2 given(header.width, header.height);
    if (given != size) {
        const std::string words = sizeInWords(given, size);
        refuse(file, fmt::format("has {} × {} pixels{}; the scene's images have {} × {}: render at that size, or score with "
                                 "the --profile that has the image's",
                                 given.x, given.y, words.empty() ? "" : ", " + words, size.x, size.y));
    }
    if (!header.whole) refuse(file, "is a window of a larger picture, or holds depth samples: write it whole and flat");
}

/// Whether a channel is called `name`, alone or in a layer: "R", "ViewLayer.Combined.R".
bool isCalled(const std::string& channel, std::string_view name) {
    return channel == name || channel.ends_with(fmt::format(".{}", name));
}

/// The indices of what is scored: one channel, or red, green and blue.
std::vector<int> chosenChannels(const ImageHeader& header, const std::string& channel, const fs::path& file) {
    std::vector<int> colours;
    for (int i = 0; i < static_cast<int>(header.channels.size()); ++i) {
        const std::string& name = header.channels[static_cast<std::size_t>(i)];
        if (!channel.empty() && name == channel) return {i};
        if (i != header.alpha && !isCalled(name, "A")) colours.push_back(i);
    }
    if (!channel.empty())
        refuse(file, fmt::format("has no channel \"{}\": it has {}", channel, fmt::join(header.channels, ", ")));
    if (colours.size() == 1) return colours;
    std::vector<int> rgb;
    for (const std::string_view name : {"R", "G", "B"})
        for (const int i : colours)
            if (isCalled(header.channels[static_cast<std::size_t>(i)], name)) rgb.push_back(i);
    if (colours.size() != 3 || rgb.size() != 3)
        refuse(file, fmt::format("has the channels {}: name the one that is visibility with --channel",
                                 fmt::join(header.channels, ", ")));
    return rgb;
}

bool isSrgb(const ImageHeader& header, Encoding encoding, const fs::path& file) {
    if (encoding == Encoding::OfFormat && !header.floats)
        refuse(file, fmt::format("has {} bits a number, which may be linear or sRGB-encoded: say --linear or --srgb",
                                 header.bits));
    return encoding == Encoding::Srgb;
}

void requireFinite(const Image<float>& channel, const fs::path& file) {
    const auto bad = [](float value) { return !std::isfinite(value); };
    const auto first = std::ranges::find_if(channel, bad);
    if (first == channel.end()) return;
    const auto at = std::distance(channel.begin(), first);
    const auto count = std::ranges::count_if(channel, bad);
    refuse(file, fmt::format("holds {} pixel{} without a finite number; the first is {} at ({}, {}): find out where the "
                             "renderer divides by nothing",
                             count, count == 1 ? "" : "s", *first, at % channel.width(), at / channel.width()));
}

} // namespace

std::string sizeInWords(glm::ivec2 given, glm::ivec2 wanted) {
    if (given.x == wanted.y && given.y == wanted.x && given.x != given.y) return "width and height swapped";
    for (const int times : {2, 4}) {
        const std::string_view word = times == 2 ? "half" : "a quarter of";
        if (given * times == wanted) return fmt::format("{} the width and height", word);
        if (given == wanted * times) return fmt::format("{} times the width and height", times);
    }
    return "";
}

ForeignImage readForeign(const fs::path& file, const Reading& reading, std::vector<std::string>& warnings) {
    ImageReader image = opened(file);
    const ImageHeader& header = image.header();
    requireFitting(header, file, reading.size);
    const std::vector<int> chosen = chosenChannels(header, reading.channel, file);
    const bool srgb = isSrgb(header, reading.encoding, file);
    if (hasPalette(header, file))
        warnings.push_back(fmt::format("image {} has a palette, so at most 256 values: save it as grey", file.string()));
    ForeignImage result{.file = file, .channels = {}, .alpha = {}};
    if (!header.floats) result.step = 1 / (std::ldexp(1.0F, header.bits) - 1);
    for (const int i : chosen) {
        Image<float>& channel = result.channels.emplace_back(image.channel(i));
        requireFinite(channel, file);
        if (srgb) std::ranges::transform(channel, channel.begin(), linearFromSrgb);
    }
    if (reading.channel.empty() && header.alpha >= 0) result.alpha = image.channel(header.alpha);
    return result;
}

Image<float> readNumbers(const fs::path& file, glm::ivec2 size) {
    ImageReader image = opened(file);
    const ImageHeader& header = image.header();
    requireFitting(header, file, size);
    const auto isDepth = [](const std::string& channel) { return isCalled(channel, "Z"); };
    const auto depth = std::ranges::find_if(header.channels, isDepth);
    if (std::ranges::count_if(header.channels, isDepth) == 1) return image.channel(*depth);
    return image.channel(chosenChannels(header, "", file).front());
}

} // namespace shadowbench::foreign
