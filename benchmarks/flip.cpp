// FLIP of two pictures, to hold it to other programs that compute it.
//
//   build/release/benchmarks/flip REFERENCE.png TEST.png [MAP.png] [--ppd 67.02]
//
// Prints the mean and, with a third file, writes the difference at each pixel: 0 is black, 1 white. PNG files are
// sRGB-encoded, EXR files linear; of a grey one all three colours are the same.
#include "harness/metrics/flip.h"
#include "base/confined/image_reader.h"
#include "base/error.h"
#include "base/srgb.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace shadowbench {
namespace {

struct Options {
    std::filesystem::path reference, test, map;
    double pixelsPerDegree = metrics::flipPixelsPerDegree;
};

Image<glm::vec3> readLinear(const std::filesystem::path& file) {
    ImageReader reader(file);
    const ImageHeader header = reader.header();
    Image<glm::vec3> picture(header.width, header.height);
    const bool grey = header.channels.size() < 3;
    for (int colour = 0; colour < 3; ++colour) {
        const Image<float> channel =
            header.floats && !grey ? reader.channel(std::string(1, "RGB"[colour])) : reader.channel(grey ? 0 : colour);
        for (std::size_t i = 0; i < picture.size(); ++i)
            picture[i][colour] = header.floats ? channel[i] : linearFromSrgb(channel[i]);
    }
    return picture;
}

void run(const Options& options) {
    const auto pictureOf = [&](const std::filesystem::path& file) {
        return metrics::flipPicture(readLinear(file), options.pixelsPerDegree);
    };
    const metrics::FlipPicture reference = pictureOf(options.reference), test = pictureOf(options.test);
    if (!reference.edges.sameSize(test.edges)) throw BadInput("comparing two pictures: they have different sizes");
    fmt::print("{:.6f}\n", metrics::meanFlip(reference, test));
    if (!options.map.empty()) writePng(options.map, metrics::flip(reference, test));
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    shadowbench::Options options;
    CLI::App app("The difference that an eye sees between two pictures that alternate: FLIP (Andersson et al. 2020)");
    app.add_option("reference", options.reference, "PNG (sRGB) or EXR (linear)")->required();
    app.add_option("test", options.test, "Another of that size")->required();
    app.add_option("map", options.map, "PNG of the difference at each pixel");
    app.add_option("--ppd", options.pixelsPerDegree, "Pixels of the display in a degree of the view")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        shadowbench::run(options);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
