// OpenEXR makes no threads here: its pool has none unless a program asks for them.
#include "base/error.h"
#include "base/image_formats.h"
#include "base/one_line.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <limits>
#include <new>
#include <tuple>

namespace shadowbench::exr {
namespace {

constexpr int inThisThread = 0;               // as a number of threads
constexpr const char* inMemory = "in memory"; // of the file, in OpenEXR's messages

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::string_view bytes) : IStream(inMemory), bytes_(bytes) {}

    bool read(char to[], int count) override {
        if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - place_) throw Iex::InputExc("It ends too early.");
        std::memcpy(to, bytes_.data() + place_, static_cast<std::size_t>(count));
        place_ += static_cast<std::size_t>(count);
        return place_ < bytes_.size();
    }
    std::uint64_t tellg() override { return place_; }
    void seekg(std::uint64_t place) override {
        if (place > bytes_.size()) throw Iex::InputExc("It ends too early.");
        place_ = place;
    }

private:
    std::string_view bytes_;
    std::size_t place_ = 0;
};

class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream(inMemory) {}

    void write(const char from[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        bytes_.resize(std::max(bytes_.size(), place_ + size)); // it goes back to fill in where its rows lie
        std::memcpy(bytes_.data() + place_, from, size);
        place_ += size;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }

    std::string taken() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t place_ = 0;
};

/// Without OpenEXR's sentence on which file it was reading.
std::string reasonOf(const std::exception& error) {
    const std::string words = onOneLine(error.what()), end = fmt::format("\"{}\". ", inMemory);
    const std::size_t place = words.rfind(end);
    return place == std::string::npos ? words : words.substr(place + end.size());
}

/// What `work` makes of the file; what OpenEXR throws becomes BadInput.
template <typename Work>
auto reading(std::string_view bytes, const Work& work) {
    try {
        MemoryInput input(bytes);
        Imf::MultiPartInputFile file(input, inThisThread);
        return work(file);
    } catch (const BadInput&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // mostly Iex's
        throw BadInput(reasonOf(error));
    }
}

struct NamedChannel {
    std::string name;
    Imf::PixelType type;
    std::string layer; // with its last dot; "" without one
    std::string end;   // of the name, after the layer, in small letters
    std::size_t rank;  // within the layer

    NamedChannel(const std::string& fullName, const Imf::Channel& channel) : name(fullName), type(channel.type) {
        static constexpr std::array<std::string_view, 11> first{"r", "red", "g",     "green", "b",    "blue",
                                                                "y", "a",   "alpha", "z",     "depth"};
        const std::size_t dot = name.find_last_of('.');
        layer = name.substr(0, dot == std::string::npos ? 0 : dot + 1);
        end = name.substr(layer.size());
        std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        rank = static_cast<std::size_t>(std::ranges::find(first, end) - first.begin());
    }

    [[nodiscard]] bool isAlpha() const { return end == "a" || end == "alpha"; }
    [[nodiscard]] auto place() const { return std::tie(layer, rank, name); }
};

std::vector<NamedChannel> channelsOf(const Imf::Header& header) {
    std::vector<NamedChannel> channels;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
        if (at.channel().xSampling != 1 || at.channel().ySampling != 1)
            throw BadInput(fmt::format("its channel \"{}\" has fewer samples than pixels: write all channels at full size",
                                       onOneLine(at.name())));
        channels.emplace_back(at.name(), at.channel());
    }
    std::ranges::sort(channels, [](const auto& a, const auto& b) { return a.place() < b.place(); });
    return channels;
}

bool hasDepthSamples(const Imf::Header& header) { return header.hasType() && Imf::isDeepData(header.type()); }

glm::ivec2 sizeOf(const Imath::Box2i& window) { return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1}; }

} // namespace

ImageHeader headerOf(std::string_view bytes) {
    return reading(bytes, [](const Imf::MultiPartInputFile& file) {
        const Imf::Header& header = file.header(0);
        const std::vector<NamedChannel> channels = channelsOf(header);
        const auto isHalf = [](const NamedChannel& channel) { return channel.type == Imf::HALF; };
        const auto isInteger = [](const NamedChannel& channel) { return channel.type == Imf::UINT; };
        const glm::ivec2 size = sizeOf(header.dataWindow());
        ImageHeader result{.format = "openexr", .width = size.x, .height = size.y, .channels = {}};
        result.bits = std::ranges::all_of(channels, isHalf) ? 16 : 32;
        result.floats = !std::ranges::all_of(channels, isInteger);
        result.whole = header.dataWindow() == header.displayWindow() && !hasDepthSamples(header);
        const auto alpha = std::ranges::find_if(channels, &NamedChannel::isAlpha);
        if (alpha != channels.end()) result.alpha = static_cast<int>(alpha - channels.begin());
        for (const NamedChannel& channel : channels) result.channels.push_back(channel.name);
        return result;
    });
}

Image<float> channelOf(std::string_view bytes, int channel) {
    return reading(bytes, [&](Imf::MultiPartInputFile& file) {
        const Imf::Header& header = file.header(0);
        if (hasDepthSamples(header)) throw BadInput("it holds depth samples: write it flat");
        const NamedChannel chosen = channelsOf(header).at(static_cast<std::size_t>(channel));
        const Imath::Box2i window = header.dataWindow();
        Image<float> image(sizeOf(window).x, sizeOf(window).y);
        const bool isInteger = chosen.type == Imf::UINT; // which OpenEXR would not divide by the maximum
        std::vector<std::uint32_t> integers(isInteger ? image.size() : 0);
        Imf::FrameBuffer pixels;
        pixels.insert(chosen.name, isInteger ? Imf::Slice::Make(Imf::UINT, integers.data(), window)
                                             : Imf::Slice::Make(Imf::FLOAT, image.data(), window));
        Imf::InputPart part(file, 0);
        part.setFrameBuffer(pixels);
        part.readPixels(window.min.y, window.max.y);
        constexpr float scale = 1.0F / static_cast<float>(std::numeric_limits<std::uint32_t>::max());
        std::ranges::transform(integers, image.begin(), [](std::uint32_t i) { return scale * static_cast<float>(i); });
        return image;
    });
}

std::string encoded(const std::vector<Channel>& channels) {
    const int width = channels.front().second->width(), height = channels.front().second->height();
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer pixels;
    for (const auto& [name, image] : channels) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        pixels.insert(name, Imf::Slice::Make(Imf::FLOAT, image->data(), header.dataWindow()));
    }
    MemoryOutput output;
    {
        Imf::OutputFile file(output, header, inThisThread);
        file.setFrameBuffer(pixels);
        file.writePixels(height);
    } // its end writes where the rows lie
    return output.taken();
}

} // namespace shadowbench::exr
