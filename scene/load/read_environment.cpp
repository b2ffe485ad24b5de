// Skies and suns of scene files.
#include "base/confined/image_reader.h"
#include "base/error.h"
#include "scene/load/scene_file.h"
#include "scene/sky.h"
#include "scene/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <numbers>

namespace shadowbench {
namespace {

constexpr std::size_t kMostCoefficients = 256; // 16 bands; more is taken for a typing error
constexpr int kWidestSky = 16384;              // pixels

double readRadiance(const TomlValue& value) {
    const double radiance = value.number();
    if (radiance < 0) value.fail(fmt::format("expected a radiance of 0 or more, got {:g}", radiance));
    return radiance;
}

double scaleOf(const TomlValue& sky) {
    const auto scale = sky.find("scale");
    return scale ? scale->positive() : 1;
}

/// Directions 3° apart, the poles among them.
void requireNotNegative(const HarmonicSky& sky, const TomlValue& value) {
    constexpr int kRows = 60, kColumns = 120;
    double least = 0, most = 0;
    glm::dvec3 darkest(0);
    for (int row = 0; row <= kRows; ++row) {
        const double polar = std::numbers::pi * row / kRows;
        for (int column = 0; column < kColumns; ++column) {
            const double turn = 2 * std::numbers::pi * column / kColumns;
            const glm::dvec3 direction(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
            const double radiance = harmonicSum(sky.coefficients, direction);
            most = std::max(most, radiance);
            if (radiance >= least) continue;
            least = radiance;
            darkest = direction;
        }
    }
    if (most <= 0) value.fail("the radiance is nowhere above 0; for a black sky give constant = 0");
    if (least < -1e-9 * most) // less is rounding, where a sum touches 0
        value.fail(
            fmt::format("the radiance is negative towards [{:.2f}, {:.2f}, {:.2f}], {:.3g} where it is {:.3g} at most; "
                        "raise the first coefficient",
                        darkest.x, darkest.y, darkest.z, least, most));
}

HarmonicSky readHarmonics(const TomlValue& value, double scale) {
    const std::vector<TomlValue> list = value.list();
    if (list.size() > kMostCoefficients || harmonicBands(list.size()) == 0)
        value.fail(fmt::format("expected a square number of coefficients (1, 4, 9, …, {}), got {}", kMostCoefficients,
                               list.size()));
    HarmonicSky sky;
    for (const TomlValue& coefficient : list) sky.coefficients.push_back(scale * coefficient.number());
    requireNotNegative(sky, value);
    return sky;
}

/// The luminance (Rec. 709) of an image with R, G and B; else its channel Y.
Image<float> luminanceOf(const std::filesystem::path& file) {
    ImageReader image(file);
    const std::vector<std::string>& channels = image.header().channels;
    const auto has = [&](const char* channel) {
        return std::find(channels.begin(), channels.end(), channel) != channels.end();
    };
    if (!has("R") || !has("G") || !has("B")) return image.channel("Y");
    Image<float> luminance = image.channel("R");
    const Image<float> green = image.channel("G"), blue = image.channel("B");
    for (std::size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = 0.2126F * luminance[i] + 0.7152F * green[i] + 0.0722F * blue[i];
    return luminance;
}

ImageSky readImageSky(const TomlValue& value, const std::filesystem::path& folder, double scale) {
    const std::filesystem::path file = folder / value.text();
    if (file.extension() != ".exr") value.fail("expected an OpenEXR file, whose name ends in .exr");
    ImageSky sky;
    try {
        sky.radiance = luminanceOf(file);
    } catch (const BadInput& error) {
        value.fail(error.what());
    }
    const int width = sky.radiance.width(), height = sky.radiance.height();
    if (width != 2 * height || width > kWidestSky)
        value.fail(
            fmt::format("expected an equirectangular image, twice as wide as high and at most {} pixels wide, got {} × {}",
                        kWidestSky, width, height));
    for (float& radiance : sky.radiance) {
        if (!std::isfinite(radiance) || radiance < 0)
            value.fail(fmt::format("a pixel has the radiance {:g}; expected finite numbers of 0 or more", radiance));
        radiance = static_cast<float>(scale * static_cast<double>(radiance));
        if (!std::isfinite(radiance)) value.fail("the scaled radiance of a pixel is not finite; make the scale smaller");
    }
    return sky;
}

Sky readSky(const TomlValue& value, const std::filesystem::path& folder) {
    value.only({"constant", "harmonics", "image", "scale"});
    const auto constant = value.find("constant"), coefficients = value.find("harmonics"), image = value.find("image");
    if (constant.has_value() + coefficients.has_value() + image.has_value() != 1)
        value.fail("expected one of constant, harmonics and image");
    if (constant) return ConstantSky{readRadiance(value.only({"constant"}).get("constant"))};
    if (coefficients) return readHarmonics(*coefficients, scaleOf(value));
    return readImageSky(*image, folder, scaleOf(value));
}

Sun readSun(const TomlValue& value) {
    constexpr double kHemisphere = 180;
    value.only({"direction", "diameter", "radiance"});
    const glm::dvec3 direction = readDirection(value.get("direction"));
    const double diameter = value.get("diameter").positive();
    if (diameter > kHemisphere) value.get("diameter").fail(fmt::format("expected degrees, at most {:g}", kHemisphere));
    return {direction, diameter, value.get("radiance").positive()};
}

bool isBlack(const Sky& sky) {
    if (const auto* constant = std::get_if<ConstantSky>(&sky)) return constant->radiance == 0;
    const auto* image = std::get_if<ImageSky>(&sky);
    return image != nullptr && std::all_of(image->radiance.begin(), image->radiance.end(), [](float l) { return l == 0; });
}

} // namespace

EnvironmentLight readEnvironment(const TomlValue& light, const std::filesystem::path& folder) {
    EnvironmentLight environment{readSky(light.get("sky"), folder), {}};
    if (const auto suns = light.find("suns"))
        for (const TomlValue& sun : suns->list()) environment.suns.push_back(readSun(sun));
    if (environment.suns.empty() && isBlack(environment.sky))
        light.get("sky").fail("is black, and there is no sun: nothing would be lit");
    return environment;
}

} // namespace shadowbench
