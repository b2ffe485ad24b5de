#include "site/figure/insets.h"

#include "base/error.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

constexpr int shareOfWidth = 5, shareOfHeight = 8; // as wide as the picture above it: five times as large, and less high

/// At each receiver, by how much the images differ; one image from the truth.
Image<float> differences(const std::vector<Image<float>>& images, const KeptTruth& truth) {
    Image<float> result(truth.surface.width(), truth.surface.height());
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (truth.surface[i] != static_cast<float>(groundtruth::Surface::Receiver)) continue;
        float low = images.size() == 1 ? truth.visibility[i] : images.front()[i], high = low;
        for (const Image<float>& image : images) {
            low = std::min(low, image[i]);
            high = std::max(high, image[i]);
        }
        result[i] = high - low;
    }
    return result;
}

/// Sums of all pixels above and left of each corner of a pixel.
Image<double> sumsOf(const Image<float>& image) {
    Image<double> sums(image.width() + 1, image.height() + 1);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sums(x + 1, y + 1) = static_cast<double>(image(x, y)) + sums(x, y + 1) + sums(x + 1, y) - sums(x, y);
    return sums;
}

} // namespace

Inset insetOf(const std::string& text) {
    Inset inset;
    char rest = 0;
    const int numbers = std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &inset.x, &inset.y, &inset.width, &inset.height, &rest);
    if (numbers != 4 || inset.width < 1 || inset.height < 1)
        throw BadInput(fmt::format("\"{}\" is no inset; write its left, top, width and height in pixels, such as "
                                   "--inset 120,80,48,32",
                                   text));
    return inset;
}

std::string textOf(const Inset& inset) { return fmt::format("{},{},{},{}", inset.x, inset.y, inset.width, inset.height); }

Inset mostTelling(const std::vector<Image<float>>& images, const KeptTruth& truth) {
    const int width = truth.surface.width(), height = truth.surface.height();
    const glm::ivec2 size(std::max(1, width / shareOfWidth), std::max(1, height / shareOfHeight));
    const Image<double> sums = sumsOf(differences(images, truth));
    Inset best{(width - size.x) / 2, (height - size.y) / 2, size.x, size.y};
    double most = 1e-6; // less is what rounding leaves
    for (int y = 0; y + size.y <= height; ++y)
        for (int x = 0; x + size.x <= width; ++x) {
            const double sum = sums(x + size.x, y + size.y) - sums(x, y + size.y) - sums(x + size.x, y) + sums(x, y);
            if (sum <= most * (1 + 1e-9)) continue; // equal but for rounding: the first stays
            most = sum;
            best = {x, y, size.x, size.y};
        }
    return best;
}

Image<glm::vec3> enlarged(const Image<glm::vec3>& picture, const Inset& part, int times) {
    Image<glm::vec3> result(part.width * times, part.height * times);
    for (int y = 0; y < result.height(); ++y)
        for (int x = 0; x < result.width(); ++x) result(x, y) = picture(part.x + x / times, part.y + y / times);
    return result;
}

} // namespace shadowbench::site
