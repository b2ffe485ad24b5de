// Images of other people through a real child: each channel of each format, and what is refused.
#include "base/confined/image_reader.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tests/support/hexadecimal.h"
#include "tests/support/message_of.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& work) { return test::messageOf<BadInput>(work); }

class ConfinedImages : public testing::Test {
protected:
    /// 4 × 2 pixels.
    fs::path exr(const std::string& name) const {
        Image<float> image(4, 2);
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<float>(i);
        writeExr(folder_.path() / name, {{"V", &image}});
        return folder_.path() / name;
    }

    const TemporaryFolder folder_;
};

TEST_F(ConfinedImages, OfSeveralChannelsGiveEachAsOftenAsItIsAskedFor) {
    const fs::path file = folder_.path() / "rgba.png"; // 2 × 2: three of (200, 100, 50, 128), the last of (0, 20, 40, 255)
    writeFile(file, test::bytesOf(
                        "89504e470d0a1a0a0000000d494844520000000200000002080600000072b60d24000000144944415478da63389162d4"
                        "00c20c604244e33f0041b906d6f467acb80000000049454e44ae426082"));
    ImageReader reader(file);
    EXPECT_EQ(reader.header().alpha, 3);
    EXPECT_EQ(reader.header().bits, 8);
    const std::array<std::array<float, 2>, 4> values{{{200, 0}, {100, 20}, {50, 40}, {128, 255}}};
    for (const int channel : {3, 0, 1, 2, 0, 3}) {
        const Image<float> read = reader.channel(channel);
        EXPECT_FLOAT_EQ(read(0, 0), values.at(static_cast<std::size_t>(channel))[0] / 255) << "not multiplied by alpha";
        EXPECT_FLOAT_EQ(read(1, 1), values.at(static_cast<std::size_t>(channel))[1] / 255);
    }
    EXPECT_FLOAT_EQ(reader.channel("G")(0, 1), 100.0F / 255);
}

TEST_F(ConfinedImages, WithoutSuchAChannelOrWithTooManyPixelsAreRefused) {
    const fs::path file = exr("a.exr");
    const std::string start = "cannot read image " + file.string() + ": ";
    EXPECT_EQ(refusal([&] { ImageReader(file).channel(1); }), start + "it has 1 channels, counted from 0, and no 1");
    EXPECT_EQ(refusal([&] { ImageReader(file).channel(-1); }), start + "it has 1 channels, counted from 0, and no -1");
    EXPECT_NE(refusal([&] { ImageReader(file).channel("Y"); }).find("channel \"Y\""), std::string::npos);
    ::setenv("SHADOWBENCH_MAX_PIXELS", "7", 1);
    EXPECT_EQ(refusal([&] { ImageReader(file).channel(0); }),
              start + "it has 4 × 2 pixels, more than the 7 of SHADOWBENCH_MAX_PIXELS, which can be raised");
    ::unsetenv("SHADOWBENCH_MAX_PIXELS");
    EXPECT_EQ(ImageReader(file).channel(0)(3, 1), 7);
}

/// Each number of an EXR's display window in turn is changed: that of its data stays.
TEST_F(ConfinedImages, ThatAreAWindowOfALargerPictureSaySo) {
    const fs::path file = exr("a.exr");
    EXPECT_TRUE(ImageReader(file).header().whole);
    const std::string bytes = readFile(file);
    const std::string name("displayWindow\0box2i\0", 20);
    const std::size_t box = bytes.find(name) + name.size() + sizeof(std::int32_t); // x and y of the first, of the last pixel
    for (const auto& [place, value] : {std::pair{0, -1}, {1, -1}, {2, 9}, {3, 9}}) {
        std::string changed = bytes;
        const std::int32_t number = value;
        std::memcpy(changed.data() + box + static_cast<std::size_t>(place) * sizeof number, &number, sizeof number);
        writeFile(file, changed);
        EXPECT_FALSE(ImageReader(file).header().whole) << place;
    }
}

} // namespace
} // namespace shadowbench
