// Image files become visibility, or one clear sentence.
#include "base/error.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "harness/foreign/visibility.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;

constexpr int side = 16;

Image<float> ramp() {
    Image<float> image(side, side);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<float>(i) / static_cast<float>(image.size() - 1);
    return image;
}

/// A little-endian PFM file, rows from the bottom.
void writePfm(const fs::path& file, const Image<float>& image) {
    std::ofstream stream(file, std::ios::binary);
    stream << "Pf\n" << image.width() << ' ' << image.height() << "\n-1.0\n";
    for (int y = image.height() - 1; y >= 0; --y)
        stream.write(reinterpret_cast<const char*>(&image(0, y)),
                     static_cast<std::streamsize>(sizeof(float)) * image.width());
}

class ForeignFiles : public testing::Test {
protected:
    fs::path exr(const std::string& name, const std::vector<Channel>& channels) {
        writeExr(folder_.path() / name, channels);
        return folder_.path() / name;
    }
    fs::path exr(const std::string& name, const Image<float>& v) { return exr(name, {{"Y", &v}}); }

    Visibility read(const FrameFiles& files, Encoding encoding = Encoding::OfFormat, const std::string& channel = "") {
        return visibilityOf(files, {{side, side}, encoding, channel}, scored_, warnings_);
    }
    Visibility read(const fs::path& file, Encoding encoding = Encoding::OfFormat) {
        return read(FrameFiles{.image = file}, encoding);
    }
    /// The sentence with which a file is refused.
    std::string refusal(const FrameFiles& files, Encoding encoding = Encoding::OfFormat, const std::string& channel = "") {
        try {
            read(files, encoding, channel);
        } catch (const BadInput& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return error.what();
        }
        return "";
    }
    std::string refusal(const fs::path& file, Encoding encoding = Encoding::OfFormat) {
        return refusal(FrameFiles{.image = file}, encoding);
    }

    static void expectIn(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
    }

    TemporaryFolder folder_;
    const Image<float> ramp_ = ramp();
    Pixels scored_ = Pixels(side, side, 1);
    std::vector<std::string> warnings_;
};

TEST_F(ForeignFiles, ExrAndPfmAreReadToTheBitAndPngToItsSteps) {
    EXPECT_EQ(read(exr("v.exr", ramp_)).v, ramp_);
    EXPECT_EQ(read(exr("rgb.exr", {{"R", &ramp_}, {"G", &ramp_}, {"B", &ramp_}})).v, ramp_);
    writePfm(folder_.path() / "v.pfm", ramp_);
    EXPECT_EQ(read(folder_.path() / "v.pfm").v, ramp_);
    const fs::path png = folder_.path() / "v.png";
    writePng(png, ramp_);
    const Image<float> eight = read(png, Encoding::Linear).v;
    for (std::size_t i = 0; i < eight.size(); ++i) EXPECT_NEAR(eight[i], ramp_[i], 0.5 / 255 + 1e-6);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ForeignFiles, IntegersMustBeSaidToBeLinearOrSrgb) {
    const fs::path png = folder_.path() / "v.png";
    Image<float> encoded = ramp_;
    for (float& v : encoded) v = srgbFromLinear(v);
    writePng(png, encoded);
    expectIn(refusal(png), "say --linear or --srgb");
    const Image<float> decoded = read(png, Encoding::Srgb).v;
    for (std::size_t i = 0; i < decoded.size(); ++i) EXPECT_NEAR(decoded[i], ramp_[i], 0.005);
}

TEST_F(ForeignFiles, AnotherSizeIsNamedWithWhatItIsToTheRightOne) {
    const Image<float> half(side / 2, side / 2, 1);
    expectIn(refusal(exr("half.exr", half)), "has 8 × 8 pixels, half the width and height; the scene's images have 16 × 16");
}

TEST_F(ForeignFiles, NumbersThatAreNoneAreCountedAndPlaced) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image<float> image = ramp_;
        image(3, 5) = bad;
        expectIn(refusal(exr("bad.exr", image)), "holds 1 pixel without a finite number; the first is");
        expectIn(refusal(exr("bad.exr", image)), "at (3, 5)");
    }
}

TEST_F(ForeignFiles, ValuesOutsideOfZeroToOneMatterAtReceivers) {
    Image<float> image = ramp_;
    image(2, 1) = 1.25F;
    image(4, 1) = -0.5F;
    expectIn(refusal(exr("bad.exr", image)), "outside [0, 1] at 2 of 256 receiver pixels, farthest at (4, 1): -0.5");
    scored_(2, 1) = scored_(4, 1) = 0; // sky
    EXPECT_EQ(refusal(exr("sky.exr", image)), "");
}

TEST_F(ForeignFiles, ColouredAndTransparentImagesAreRefusedAtReceivers) {
    Image<float> red = ramp_, alpha(side, side, 1);
    red(7, 2) = 0;
    const auto coloured = [&] { return exr("c.exr", {{"R", &red}, {"G", &ramp_}, {"B", &ramp_}}); };
    expectIn(refusal(coloured()), "is coloured: red, green and blue differ by");
    expectIn(refusal(coloured()), "at receiver pixel (7, 2)");
    const auto transparent = [&] { return exr("a.exr", {{"R", &ramp_}, {"G", &ramp_}, {"B", &ramp_}, {"A", &alpha}}); };
    EXPECT_EQ(refusal(transparent()), "") << "alpha is 1 everywhere";
    alpha(1, 1) = 0.5F;
    expectIn(refusal(transparent()), "is transparent: alpha is 0.5 at receiver pixel (1, 1)");
}

TEST_F(ForeignFiles, AmongOtherChannelsOneMustBeNamed) {
    const Image<float> other(side, side, 0.5F);
    const fs::path file = exr("layers.exr", {{"shadow", &ramp_}, {"mask", &other}});
    expectIn(refusal(file), "name the one that is visibility with --channel");
    EXPECT_EQ(read(FrameFiles{.image = file}, Encoding::OfFormat, "shadow").v, ramp_);
    expectIn(refusal(FrameFiles{.image = file}, Encoding::OfFormat, "shadows"), "has no channel \"shadows\": it has");
}

TEST_F(ForeignFiles, MissingDamagedAndOtherFilesAreNamed) {
    expectIn(refusal(folder_.path() / "none.exr"), "is not there");
    expectIn(refusal(folder_.path()), "is a folder");
    std::ofstream(folder_.path() / "text.exr") << "no image";
    expectIn(refusal(folder_.path() / "text.exr"), "cannot read image");
    for (const std::string name : {"v.exr", "v.png", "v.pfm"}) {
        const fs::path file = folder_.path() / name;
        Image<float> noise(side, side);
        for (std::size_t i = 0; i < noise.size(); ++i)
            noise[i] = static_cast<float>(i * i * 7919 % 1009) / 1009; // packs badly
        if (name == "v.png")
            writePng(file, ramp_);
        else if (name == "v.pfm")
            writePfm(file, noise);
        else
            writeExr(file, {{"Y", &noise}});
        fs::resize_file(file, fs::file_size(file) * 2 / 3);
        expectIn(refusal(file, Encoding::Linear), name);
    }
}

TEST_F(ForeignFiles, VisibilityIsTheQuotientOfWhatTheLightAdds) {
    Image<float> ambient(side, side, 0.2F), lit(side, side), image(side, side);
    for (std::size_t i = 0; i < lit.size(); ++i) {
        lit[i] = 0.2F + 0.6F * (0.5F + 0.5F * ramp_[i]); // shading
        image[i] = 0.2F + (lit[i] - 0.2F) * ramp_[i];
    }
    const FrameFiles files{.image = exr("i.exr", image), .lit = exr("a.exr", lit), .unlit = exr("b.exr", ambient)};
    const Visibility found = read(files);
    for (std::size_t i = 0; i < found.v.size(); ++i) EXPECT_NEAR(found.v[i], ramp_[i], 1e-5);

    FrameFiles without = files;
    without.lit.reset();
    expectIn(refusal(without), "give --lit");
    FrameFiles same = files;
    same.unlit = same.lit;
    expectIn(refusal(same), "shows no light on any receiver");
}

TEST_F(ForeignFiles, WhereThereIsNothingToDivideByNothingIsKnown) {
    Image<float> lit(side, side, 1), image = ramp_;
    for (int x = 0; x < 8; ++x) lit(x, 0) = image(x, 0) = 0; // 8 of 256
    const Visibility found = read(FrameFiles{.image = exr("i.exr", image), .lit = exr("a.exr", lit)});
    EXPECT_EQ(found.unknown(3, 0), 1);
    EXPECT_EQ(found.unknown(3, 1), 0);
    for (int x = 0; x < 16; ++x) lit(x, 0) = 0;
    expectIn(refusal(FrameFiles{.image = exr("i.exr", image), .lit = exr("a.exr", lit)}),
             "too dark to divide by at 16 of 256");
}

} // namespace
} // namespace shadowbench::foreign
