#include "base/image_io.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_input.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <vector>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void failToWrite(const fs::path& file, const std::string& reason) {
    throw InternalError(fmt::format("cannot write {}: {}; free some space or choose another place", file.string(),
                                    reason.empty() ? "the library does not say why" : inOneLine(reason)));
}

/// Into memory first: the library does not notice when what it has buffered cannot be written.
void write(const fs::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output) failToWrite(file, OIIO::geterror());
    if (!output->set_ioproxy(&memory)) failToWrite(file, "the library cannot write this format into memory");
    if (!output->open(file.string(), spec)) failToWrite(file, output->geterror());
    if (!output->write_image(spec.format, pixels)) failToWrite(file, output->geterror());
    if (!output->close()) failToWrite(file, output->geterror());
    writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(std::isnan(value) ? 0.0F : value, 0.0F, 1.0F)));
}

[[noreturn]] void failToRead(const fs::path& file, const std::string& reason) {
    throw BadInput(fmt::format("cannot read image {}: {}", file.string(), reason));
}

std::unique_ptr<OIIO::ImageInput> openImage(const fs::path& file) {
    const OIIO::ImageSpec wanted = asStored();
    auto input = OIIO::ImageInput::open(file.string(), &wanted);
    if (!input) failToRead(file, inOneLine(OIIO::geterror()));
    return input;
}

Image<float> read(OIIO::ImageInput& input, const fs::path& file, int channel) {
    try {
        return pixelsOf(input, channel);
    } catch (const BadInput& error) {
        failToRead(file, error.what());
    }
}

} // namespace

void writeExr(const fs::path& file, const std::vector<Channel>& channels) {
    if (channels.empty()) throw InternalError(fmt::format("cannot write {}: no channels were given", file.string()));
    const Image<float>& first = *channels.front().second;
    OIIO::ImageSpec spec(first.width(), first.height(), static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "2000:01:01 00:00:00"); // the writer stamps the time of day otherwise: same input, same bytes
    spec.channelnames.clear();
    std::vector<float> interleaved(first.size() * channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto& [name, image] = channels[c];
        if (!image->sameSize(first))
            throw InternalError(fmt::format("cannot write {}: channel {} has another size", file.string(), name));
        spec.channelnames.push_back(name);
        for (std::size_t i = 0; i < image->size(); ++i) interleaved[i * channels.size() + c] = (*image)[i];
    }
    write(file, spec, interleaved.data());
}

void writePng(const fs::path& file, const Image<float>& grey) {
    std::vector<std::uint8_t> bytes(grey.size());
    std::transform(grey.begin(), grey.end(), bytes.begin(), byte);
    write(file, OIIO::ImageSpec(grey.width(), grey.height(), 1, OIIO::TypeDesc::UINT8), bytes.data());
}

void writePng(const fs::path& file, const Image<glm::vec3>& colour) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * colour.size());
    for (const glm::vec3& c : colour) bytes.insert(bytes.end(), {byte(c.x), byte(c.y), byte(c.z)});
    write(file, OIIO::ImageSpec(colour.width(), colour.height(), 3, OIIO::TypeDesc::UINT8), bytes.data());
}

Image<float> readChannel(const fs::path& file, int channel) {
    const auto input = openImage(file);
    const OIIO::ImageSpec& spec = input->spec();
    if (channel < 0 || channel >= spec.nchannels)
        throw BadInput(fmt::format("cannot read channel {} of image {}: it has {} channels, counted from 0", channel,
                                   file.string(), spec.nchannels));
    return read(*input, file, channel);
}

Image<float> readChannel(const fs::path& file, const std::string& channel) {
    const auto input = openImage(file);
    const std::vector<std::string>& names = input->spec().channelnames;
    const auto found = std::find(names.begin(), names.end(), channel);
    if (found == names.end())
        throw BadInput(fmt::format("cannot read channel \"{}\" of image {}: it has {}", channel, file.string(),
                                   fmt::join(names, ", ")));
    return read(*input, file, static_cast<int>(found - names.begin()));
}

} // namespace shadowbench
