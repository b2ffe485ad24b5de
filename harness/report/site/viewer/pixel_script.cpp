#include "harness/report/site/viewer/pixel_script.h"

#include "base/error.h"

#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

namespace shadowbench::site {
namespace {

/// Neighbours differ little in their high bytes, so that these compress well once they stand together.
std::string planes(const std::vector<float>& values) {
    std::string bytes(4 * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto bits = std::bit_cast<std::uint32_t>(values[i]);
        for (std::size_t plane = 0; plane < 4; ++plane)
            bytes[plane * values.size() + i] = static_cast<char>(bits >> (8 * plane) & 0xFFU);
    }
    return bytes;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string result(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                  Z_BEST_COMPRESSION) != Z_OK)
        throw InternalError("making pages: compressing pixel values failed");
    result.resize(size);
    return result;
}

std::string base64(const std::string& bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < count; ++k)
            bits |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i + k])) << (16 - 8 * k);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[bits >> (18 - 6 * k) & 0x3FU] : '=';
    }
    return text;
}

} // namespace

std::string packed(const std::vector<float>& values) { return base64(deflated(planes(values))); }

std::string pixelScript(std::string_view name, const std::vector<std::pair<std::string, std::vector<float>>>& channels) {
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const auto& [channel, image] : channels) values[channel] = packed(image);
    return fmt::format("shadowbench.pixels({}, {});\n", nlohmann::json(name).dump(), values.dump());
}

std::vector<float> valuesOf(const Image<float>& image) { return {image.begin(), image.end()}; }

} // namespace shadowbench::site
