#include "site/viewer/pixel_script.h"

#include "base/base64.h"
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

/// Not as small as it could be: the last few percent take ten times as long.
std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string result(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                  Z_DEFAULT_COMPRESSION) != Z_OK)
        throw InternalError("making pages: compressing pixel values failed");
    result.resize(size);
    return result;
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
