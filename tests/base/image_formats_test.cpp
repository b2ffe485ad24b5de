// Small files of each format: what is read of them, and that they are refused wherever they are cut off.
#include "base/confined/decoded_image.h"
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tests/support/hexadecimal.h"
#include "tests/support/message_of.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {
namespace {

using namespace std::string_literals;

constexpr float infinity = std::numeric_limits<float>::infinity();

struct File {
    std::string name, bytes;
    std::string header; // in words
    std::vector<std::vector<float>> channels;
};

std::string inWords(const ImageHeader& header) {
    return fmt::format("{} {} × {}, {}, alpha {}, {} {}{}", header.format, header.width, header.height,
                       fmt::join(header.channels, " "), header.alpha, header.bits, header.floats ? "floats" : "integers",
                       header.whole ? "" : ", a part");
}

struct ExrChannel {
    std::string name;
    Imf::PixelType type; // HALF and FLOAT are written from floats; UINT: from all bits, and none
    int sampling = 1;
};

/// 2 × 2 pixels of the numbers 1, 2, 3 and infinity, plus the channel's place in `channels` times 4.
std::string exr(const std::vector<ExrChannel>& channels, bool tiled = false) {
    Imf::Header header(2, 2);
    Imf::FrameBuffer pixels;
    std::vector<std::vector<Imath::half>> halves;
    std::vector<std::vector<float>> floats;
    std::vector<std::uint32_t> integers{0xFFFFFFFFU, 0, 0xFFFFFFFFU, 0};
    halves.reserve(channels.size());
    floats.reserve(channels.size());
    for (const auto& [name, type, sampling] : channels) {
        header.channels().insert(name, Imf::Channel(type, sampling, sampling));
        const auto first = static_cast<float>(4 * floats.size());
        floats.push_back({first + 1, first + 2, first + 3, infinity});
        halves.emplace_back(floats.back().begin(), floats.back().end());
        const void* from = integers.data();
        if (type == Imf::HALF) from = halves.back().data();
        if (type == Imf::FLOAT) from = floats.back().data();
        pixels.insert(name, Imf::Slice::Make(type, from, header.dataWindow(), 0, 0, sampling, sampling));
    }
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "a.exr").string();
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(1, 1));
        Imf::TiledOutputFile output(file.c_str(), header);
        output.setFrameBuffer(pixels);
        output.writeTiles(0, 1, 0, 1);
    } else {
        Imf::OutputFile output(file.c_str(), header);
        output.setFrameBuffer(pixels);
        output.writePixels(2);
    }
    return readFile(file);
}

const std::vector<File>& files() {
    const auto exrValues = [](float first) { return std::vector<float>{first + 1, first + 2, first + 3, infinity}; };
    static const std::vector<File> all{
        {"ExrInItsOrder",
         exr({{"R", Imf::HALF},
              {"A", Imf::HALF},
              {"view.A", Imf::FLOAT},
              {"custom", Imf::FLOAT},
              {"view.R", Imf::FLOAT},
              {"G", Imf::HALF},
              {"B", Imf::HALF},
              {"Z", Imf::FLOAT}}),
         "openexr 2 × 2, R G B A Z custom view.R view.A, alpha 3, 32 floats",
         {exrValues(0), exrValues(20), exrValues(24), exrValues(4), exrValues(28), exrValues(12), exrValues(16),
          exrValues(8)}},
        {"ExrOfHalves", exr({{"Y", Imf::HALF}}), "openexr 2 × 2, Y, alpha -1, 16 floats", {exrValues(0)}},
        {"ExrInTiles",
         exr({{"Y", Imf::HALF}, {"id", Imf::UINT}}, true),
         "openexr 2 × 2, Y id, alpha -1, 32 floats",
         {exrValues(0), {1, 0, 1, 0}}},
        {"ExrOfIntegers", exr({{"id", Imf::UINT}}), "openexr 2 × 2, id, alpha -1, 32 integers", {{1, 0, 1, 0}}},
        {"PngOf16Bits",
         test::bytesOf("89504e470d0a1a0a0000000d494844520000000200000001100000000081d9fc150000000d4944415478da636060fcff"
                       "1f0003050200be03bd8f0000000049454e44ae426082"),
         "png 2 × 1, Y, alpha -1, 16 integers",
         {{1 / 65535.0F, 1}}},
        {"PngWithAPaletteAndTransparency",
         test::bytesOf("89504e470d0a1a0a0000000d4948445200000002000000010203000000894c971900000009504c5445000000ff003300"
                       "66ff9b9c36ef0000000274524e530033c943ac2e0000000a4944415478da63480000006200611c10037f000000004945"
                       "4e44ae426082"),
         "png 2 × 1, R G B A, alpha 3, 8 integers",
         {{1, 0}, {0, 0.4F}, {0.2F, 1}, {0.2F, 1}}},
        {"PngWithATransparentColour",
         test::bytesOf("89504e470d0a1a0a0000000d49484452000000020000000108020000007b40e8dd0000000674524e5300ff0033000082"
                       "ef9bd40000000f4944415478da636030feffdf9801000865026539bfa5bd0000000049454e44ae426082"),
         "png 2 × 1, R G B A, alpha 3, 8 integers",
         {{0, 1}, {0.2F, 0.2F}, {1, 0}, {1, 0}}},
        {"PngInterlacedOf4Bits",
         test::bytesOf("89504e470d0a1a0a0000000d4948445200000002000000020400000001e52a8f6f0000000e4944415478da6360600860"
                       "580f0001a50100ef15284b0000000049454e44ae426082"),
         "png 2 × 2, Y, alpha -1, 8 integers",
         {{0, 5 / 15.0F, 10 / 15.0F, 1}}},
        {"P1WithoutBlanks", "P1\n# a comment\n3 2\n011\n1 0 0", "pnm 3 × 2, Y, alpha -1, 8 integers", {{1, 0, 0, 0, 1, 1}}},
        {"P2", "P2 2 2\n100\n50 100\n# between\n120 0", "pnm 2 × 2, Y, alpha -1, 8 integers", {{0.5F, 1, 1, 0}}},
        {"P3",
         "P3\n1 2 1000 0 500 1000\n250 0 4",
         "pnm 1 × 2, R G B, alpha -1, 16 integers",
         {{0, 0.25F}, {0.5F, 0}, {1, 0.004F}}},
        {"P4",
         "P4 9 2\n\x7F\x80\xFF\x00"s,
         "pnm 9 × 2, Y, alpha -1, 8 integers",
         {{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}}},
        {"P5", "P5 2 1 65535\n\xFF\xFF\x00\x01"s, "pnm 2 × 1, Y, alpha -1, 16 integers", {{1, 1 / 65535.0F}}},
        {"P6",
         "P6 # of two pixels\n2 1 255 \x33\x66\xFF\x00 \x99"s,
         "pnm 2 × 1, R G B, alpha -1, 8 integers",
         {{0.2F, 0}, {0.4F, 32 / 255.0F}, {1, 0.6F}}},
        {"PfmFromTheBottomLittleEndian",
         "Pf\n1 2\n-1.0\n"s + "\x00\x00\x80\x3F\x00\x00\x80\x7F"s,
         "pnm 1 × 2, Y, alpha -1, 32 floats",
         {{infinity, 1}}},
        {"PfmOfColoursBigEndianScaled",
         "PF 1 1 2\n\x3F\x80\x00\x00\xC0\x00\x00\x00\x00\x00\x00\x00"s,
         "pnm 1 × 1, R G B, alpha -1, 32 floats",
         {{2}, {-4}, {0}}}};
    return all;
}

class ImageFormats : public testing::TestWithParam<File> {};

TEST_P(ImageFormats, AreRead) {
    const File& file = GetParam();
    const DecodedImage image(file.bytes);
    EXPECT_EQ(inWords(image.header()), file.header);
    ASSERT_EQ(image.header().channels.size(), file.channels.size());
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
        const Image<float> channel = image.channel(static_cast<int>(c));
        ASSERT_EQ(channel.size(), file.channels[c].size());
        for (std::size_t i = 0; i < channel.size(); ++i)
            EXPECT_FLOAT_EQ(channel[i], file.channels[c][i]) << "channel " << c << ", pixel " << i;
    }
}

TEST_P(ImageFormats, AreRefusedWhereverTheyAreCutOff) {
    const std::string& whole = GetParam().bytes;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string why = test::messageOf<BadInput>([&] { DecodedImage(whole.substr(0, length)).channel(0); });
        EXPECT_NE(why, "") << "the first " << length << " of " << whole.size() << " bytes";
        EXPECT_EQ(why.find('\n'), std::string::npos);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, ImageFormats, testing::ValuesIn(files()), [](const auto& test) { return test.param.name; });

std::string refusal(const std::string& bytes) {
    return test::messageOf<BadInput>([&] { DecodedImage(bytes).channel(0); });
}

TEST(ImageFormats, SayWhatTheyDoNotRead) {
    EXPECT_EQ(refusal(exr({{"R", Imf::HALF}, {"RY", Imf::HALF, 2}})),
              "its channel \"RY\" has fewer samples than pixels: write all channels at full size");
    EXPECT_EQ(refusal("P5 2 0 255\n\1\1"), "it has 2 × 0 pixels");
    EXPECT_EQ(refusal("P5 2 1 70000\n\1\1\1\1"), "its maximum is 70000; expected 1 to 65535");
    EXPECT_EQ(refusal("P5 2 x 255\n\1\1"), "its height is no number that is possible there");
    EXPECT_EQ(refusal("P5 2 1 255x\1\1"), "its header is damaged: no blank ends it");
    EXPECT_EQ(refusal("P1 1 1 2"), "a pixel is neither 0 nor 1");
    EXPECT_EQ(refusal("P2 1 1 9 -1"), "its pixel is no number that is possible there");
    EXPECT_EQ(refusal("P4 30000 30000\n\1"),
              "it has 30000 × 30000 pixels, more than the 134217728 of SHADOWBENCH_MAX_PIXELS, which can be raised");
    EXPECT_EQ(refusal("P4 3000 30000\n\1"), "it ends too early");
    EXPECT_EQ(refusal("P7\n"), "it is no EXR, PNG or PFM file");
    EXPECT_EQ(refusal(""), "it is empty");
    EXPECT_EQ(DecodedImage("II*\0"s).header().format, "tiff");
    EXPECT_EQ(DecodedImage("GIF89a").header().format, "gif");
}

} // namespace
} // namespace shadowbench
