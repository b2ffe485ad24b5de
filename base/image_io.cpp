#include "base/image_io.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_formats.h"
#include "base/image_input.h"
#include "base/one_line.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <new>
#include <vector>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

/// Into memory first: a library does not notice when what it has buffered cannot be written.
template <typename Encode>
void write(const fs::path& file, const Encode& encode) {
    std::string bytes;
    try {
        bytes = encode();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // the library's
        throw InternalError(fmt::format("cannot write {}: {}", file.string(), onOneLine(error.what())));
    }
    writeFile(file, bytes);
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(std::isnan(value) ? 0.0F : value, 0.0F, 1.0F)));
}

/// What `work` makes of an image's bytes and header.
template <typename Work>
Image<float> reading(const fs::path& file, const Work& work) {
    const std::string bytes = readFile(file);
    try {
        return work(bytes, headerOf(bytes));
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("cannot read image {}: {}", file.string(), error.what()));
    }
}

} // namespace

void writeExr(const fs::path& file, const std::vector<Channel>& channels) {
    if (channels.empty()) throw InternalError(fmt::format("cannot write {}: no channels were given", file.string()));
    const Image<float>& first = *channels.front().second;
    for (const auto& [name, image] : channels)
        if (!image->sameSize(first))
            throw InternalError(fmt::format("cannot write {}: channel {} has another size", file.string(), name));
    write(file, [&] { return exr::encoded(channels); });
}

void writePng(const fs::path& file, const Image<float>& grey) {
    std::vector<std::uint8_t> bytes(grey.size());
    std::transform(grey.begin(), grey.end(), bytes.begin(), byte);
    write(file, [&] { return png::encoded(grey.width(), grey.height(), 1, bytes); });
}

void writePng(const fs::path& file, const Image<glm::vec3>& colour) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * colour.size());
    for (const glm::vec3& c : colour) bytes.insert(bytes.end(), {byte(c.x), byte(c.y), byte(c.z)});
    write(file, [&] { return png::encoded(colour.width(), colour.height(), 3, bytes); });
}

Image<float> readChannel(const fs::path& file, int channel) {
    return reading(file,
                   [&](const std::string& bytes, const ImageHeader& header) { return channelOf(bytes, header, channel); });
}

Image<float> readChannel(const fs::path& file, const std::string& channel) {
    return reading(file, [&](const std::string& bytes, const ImageHeader& header) {
        const auto found = std::ranges::find(header.channels, channel);
        if (found == header.channels.end())
            throw BadInput(fmt::format("it has no channel \"{}\": it has {}", channel, fmt::join(header.channels, ", ")));
        return channelOf(bytes, header, static_cast<int>(found - header.channels.begin()));
    });
}

} // namespace shadowbench
