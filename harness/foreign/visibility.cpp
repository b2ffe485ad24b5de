#include "harness/foreign/visibility.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace shadowbench::foreign {
namespace {

std::string place(const Image<float>& image, std::size_t i) {
    const auto width = static_cast<std::size_t>(image.width());
    return fmt::format("({}, {})", i % width, i / width);
}

void requireOpaque(const ForeignImage& image, const Pixels& scored) {
    constexpr float opaque = 1 - 1.0F / 512;
    for (std::size_t i = 0; i < image.alpha.size(); ++i)
        if (scored[i] != 0 && image.alpha[i] < opaque)
            throw BadInput(fmt::format("image {} is transparent: alpha is {:.3g} at receiver pixel {}; write visibility "
                                       "without an alpha channel, or with 1 in it",
                                       image.file.string(), image.alpha[i], place(image.alpha, i)));
}

void requireGrey(const ForeignImage& image, const Pixels& scored) {
    const float allowed = std::max(2e-3F, 1.5F * image.step);
    double largest = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < scored.size(); ++i) {
        if (scored[i] == 0) continue;
        float low = image.channels[0][i], high = low;
        for (const Image<float>& channel : image.channels) {
            low = std::min(low, channel[i]);
            high = std::max(high, channel[i]);
        }
        if (high - low <= largest) continue;
        largest = high - low;
        at = i;
    }
    if (largest > allowed)
        throw BadInput(
            fmt::format("image {} is coloured: red, green and blue differ by {:.3g} at receiver pixel {}; an image "
                        "of visibility is grey, and of a shaded picture visibility is had with --lit and --unlit",
                        image.file.string(), largest, place(image.channels[0], at)));
}

/// The channels' sum at a pixel.
float sum(const ForeignImage& image, std::size_t i) {
    float total = 0;
    for (const Image<float>& channel : image.channels) total += channel[i];
    return total;
}

} // namespace

Image<float> greyOf(const ForeignImage& image, const Pixels& scored) {
    requireOpaque(image, scored);
    requireGrey(image, scored);
    return image.channels[0];
}

void requireShares(const Image<float>& v, const Pixels& scored, const std::filesystem::path& file) {
    constexpr float rounding = 0x1p-10F; // of 1 in a 16-bit float
    std::size_t outside = 0, all = 0, farthest = 0;
    float distance = rounding;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (scored[i] == 0) continue;
        ++all;
        const float beyond = std::max(-v[i], v[i] - 1);
        if (beyond > rounding) ++outside;
        if (beyond <= distance) continue;
        distance = beyond;
        farthest = i;
    }
    if (outside == 0) return;
    throw BadInput(
        fmt::format("image {} lies outside [0, 1] at {} of {} receiver pixels, farthest at {}: {:.4g}; visibility "
                    "is a share, and of a shaded picture it is had with --lit and --unlit",
                    file.string(), outside, all, place(v, farthest), v[farthest]));
}

Visibility quotient(const ForeignImage& image, const ForeignImage& lit, const ForeignImage* unlit, const Pixels& scored) {
    if (image.channels.size() != lit.channels.size() || (unlit != nullptr && unlit->channels.size() != lit.channels.size()))
        throw BadInput(fmt::format("images {} and {} do not have the same channels: write all pictures of a quotient alike",
                                   image.file.string(), lit.file.string()));
    const std::size_t pixels = scored.size();
    Image<float> light(scored.width(), scored.height());
    float brightest = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        light[i] = sum(lit, i) - (unlit != nullptr ? sum(*unlit, i) : 0);
        if (scored[i] != 0) brightest = std::max(brightest, light[i]);
    }
    if (!(brightest > 0))
        throw BadInput(fmt::format("image {} shows no light on any receiver that the picture without it lacks: --lit is the "
                                   "picture with this light and without shadows",
                                   lit.file.string()));
    const float least = std::max(1e-4F * brightest, 16 * std::max(lit.step, image.step));
    Visibility result{Image<float>(scored.width(), scored.height(), 1), Pixels(scored.width(), scored.height())};
    std::size_t all = 0, unknown = 0, far = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (scored[i] == 0) continue;
        ++all;
        if (light[i] < least) {
            result.unknown[i] = 1;
            ++unknown;
            continue;
        }
        const float v = (sum(image, i) - (unlit != nullptr ? sum(*unlit, i) : 0)) / light[i];
        if (v < -0.1F || v > 1.1F) ++far;
        result.v[i] = std::clamp(v, 0.0F, 1.0F);
    }
    if (1000 * unknown > all)
        throw BadInput(
            fmt::format("image {} is too dark to divide by at {} of {} receiver pixels (limit 0.1 %): light them more, or "
                        "write floats",
                        lit.file.string(), unknown, all));
    if (100 * far > all)
        throw BadInput(
            fmt::format("image {} divided by {} lies outside [0, 1] by more than 0.1 at {} of {} receiver pixels: "
                        "the pictures differ in more than shadows",
                        image.file.string(), lit.file.string(), far, all));
    return result;
}

Visibility visibilityOf(const FrameFiles& files, const Reading& reading, const Pixels& scored,
                        std::vector<std::string>& warnings) {
    if (files.unlit && !files.lit)
        throw BadInput(fmt::format("image {} says what is without light and nothing what is with it: give --lit, too",
                                   files.unlit->string()));
    const ForeignImage image = readForeign(files.image, reading, warnings);
    if (!files.lit) {
        Visibility result{greyOf(image, scored), {}};
        requireShares(result.v, scored, files.image);
        return result;
    }
    const ForeignImage lit = readForeign(*files.lit, reading, warnings);
    std::optional<ForeignImage> unlit;
    if (files.unlit) unlit = readForeign(*files.unlit, reading, warnings);
    return quotient(image, lit, unlit ? &*unlit : nullptr, scored);
}

} // namespace shadowbench::foreign
