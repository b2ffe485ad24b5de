// Image files become visibility, or one clear sentence.
#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/srgb.h"
#include "base/temporary_folder.h"
#include "harness/foreign/foreign_image.h"
#include "harness/foreign/visibility.h"
#include "tests/support/hexadecimal.h"

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

/// A little-endian PFM file, rows from the bottom: of one channel or of three.
void writePfm(const fs::path& file, const std::vector<const Image<float>*>& channels) {
    const Image<float>& first = *channels.front();
    std::ofstream stream(file, std::ios::binary);
    stream << (channels.size() == 3 ? "PF\n" : "Pf\n") << first.width() << ' ' << first.height() << "\n-1.0\n";
    for (int y = first.height() - 1; y >= 0; --y)
        for (int x = 0; x < first.width(); ++x)
            for (const Image<float>* channel : channels)
                stream.write(reinterpret_cast<const char*>(&(*channel)(x, y)), sizeof(float));
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
    writePfm(folder_.path() / "v.pfm", {&ramp_});
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

TEST_F(ForeignFiles, NumbersThatAreNoneAreCountedInThePlural) {
    Image<float> image = ramp_;
    image(3, 5) = image(4, 6) = std::numeric_limits<float>::infinity();
    expectIn(refusal(exr("bad.exr", image)), "holds 2 pixels without a finite number; the first is inf at (3, 5)");
}

TEST_F(ForeignFiles, OfAnotherFormatOrOfNoRelatedSizeAreRefused) {
    std::ofstream(folder_.path() / "v.bmp", std::ios::binary) << "BM" << std::string(52, '\0');
    expectIn(refusal(folder_.path() / "v.bmp"), "is of the format bmp: give EXR, PNG or PFM");
    expectIn(refusal(exr("odd.exr", Image<float>(5, 7, 1))), "has 5 × 7 pixels; the scene's images have 16 × 16");
}

/// 16 × 16 pixels of two entries of a palette: black in the left half, white in the right one.
std::string pngWithPalette() {
    return test::bytesOf("89504e470d0a1a0a0000000d4948445200000010000000100103000000253d6d2200000006504c5445000000ffffffa5"
                         "d99fdd0000000e4944415478da6360f8cf400a020076c70ff1f9ef6fae0000000049454e44ae426082");
}

TEST_F(ForeignFiles, OfThreeEqualColoursAreReadAsOfOneGrey) {
    Image<glm::vec3> grey(side, side);
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = glm::vec3(ramp_[i]);
    writePng(folder_.path() / "rgb.png", grey);
    const Image<float> eight = read(folder_.path() / "rgb.png", Encoding::Linear).v;
    for (std::size_t i = 0; i < eight.size(); ++i) EXPECT_NEAR(eight[i], ramp_[i], 0.5 / 255 + 1e-6);
    writePfm(folder_.path() / "rgb.pfm", {&ramp_, &ramp_, &ramp_});
    EXPECT_EQ(read(folder_.path() / "rgb.pfm").v, ramp_);
    fs::resize_file(folder_.path() / "rgb.pfm", fs::file_size(folder_.path() / "rgb.pfm") / 2);
    expectIn(refusal(folder_.path() / "rgb.pfm"), "rgb.pfm");
}

TEST_F(ForeignFiles, ColoursOfEachFormatAreToldApart) {
    Image<float> red = ramp_;
    red(7, 2) = 0;
    writePfm(folder_.path() / "c.pfm", {&red, &ramp_, &ramp_});
    expectIn(refusal(folder_.path() / "c.pfm"), "is coloured: red, green and blue differ by");
    Image<glm::vec3> coloured(side, side, glm::vec3(1));
    coloured(7, 2) = glm::vec3(1, 1, 0.5F);
    writePng(folder_.path() / "c.png", coloured);
    expectIn(refusal(folder_.path() / "c.png", Encoding::Linear), "at receiver pixel (7, 2)");
}

TEST_F(ForeignFiles, OfAPaletteAreReadWithAWarning) {
    const fs::path file = folder_.path() / "palette.png";
    std::ofstream(file, std::ios::binary) << pngWithPalette();
    const Visibility found = read(file, Encoding::Linear);
    EXPECT_EQ(found.v(7, 3), 0);
    EXPECT_EQ(found.v(8, 3), 1);
    ASSERT_EQ(warnings_.size(), 1U);
    expectIn(warnings_.front(), "has a palette, so at most 256 values: save it as grey");
}

TEST_F(ForeignFiles, OfAWindowOfALargerPictureAreRefused) {
    const fs::path file = exr("window.exr", ramp_);
    std::string bytes = readFile(file);
    const std::string name("displayWindow\0box2i\0", 20);
    bytes[bytes.find(name) + name.size() + 12] = 99; // its right edge
    std::ofstream(file, std::ios::binary) << bytes;
    expectIn(refusal(file), "is a window of a larger picture, or holds depth samples: write it whole and flat");
}

TEST_F(ForeignFiles, DepthIsTheChannelZAmongOthers) {
    const Image<float> other(side, side, 0.5F);
    const glm::ivec2 size(side, side);
    EXPECT_EQ(readNumbers(exr("z.exr", {{"R", &other}, {"Z", &ramp_}, {"mask", &other}}), size), ramp_);
    EXPECT_EQ(readNumbers(exr("layer.exr", {{"View.Z", &ramp_}, {"View.mask", &other}}), size), ramp_);
    EXPECT_EQ(readNumbers(exr("one.exr", ramp_), size), ramp_);
    EXPECT_THROW(readNumbers(exr("two.exr", {{"a.Z", &ramp_}, {"b.Z", &other}}), size), BadInput) << "which of them?";
    expectIn(refusal(exr("three.exr", {{"R", &ramp_}, {"G", &ramp_}, {"mask", &other}})), "name the one that is visibility");
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
            writePfm(file, {&noise});
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
    constexpr int size = 64; // of which four pixels are less than a thousandth
    const ForeignImage image{"image", {Image<float>(size, size, 0.5F)}, {}};
    ForeignImage lit{"lit", {Image<float>(size, size, 1)}, {}};
    const Pixels scored(size, size, 1);
    for (int x = 0; x < 4; ++x) lit.channels[0](x, 0) = 0;
    const Visibility found = quotient(image, lit, nullptr, scored);
    EXPECT_EQ(found.unknown(3, 0), 1);
    EXPECT_EQ(found.unknown(3, 1), 0);
    lit.channels[0](4, 0) = 0;
    try {
        quotient(image, lit, nullptr, scored);
        ADD_FAILURE() << "more is unknown than may be";
    } catch (const BadInput& error) {
        expectIn(error.what(), "too dark to divide by at 5 of 4096 receiver pixels (limit 0.1 %)");
    }
}

} // namespace
} // namespace shadowbench::foreign
