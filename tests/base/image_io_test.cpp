#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

class ImageFiles : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    const fs::path folder_ = fs::temp_directory_path() / ("shadowbench-images-" + std::to_string(::getpid()));
};

Image<float> ramp(int width, int height) {
    Image<float> image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<float>(i) / static_cast<float>(image.size() - 1);
    return image;
}

TEST_F(ImageFiles, AnExrKeepsEveryChannelToTheLastBit) {
    const Image<float> visibility = ramp(7, 5);
    Image<float> distance(7, 5, std::numeric_limits<float>::infinity());
    distance(3, 2) = 1e-30F;
    writeExr(folder_ / "a.exr", {{"V", &visibility}, {"distance", &distance}});
    EXPECT_EQ(readChannel(folder_ / "a.exr", "V"), visibility);
    EXPECT_EQ(readChannel(folder_ / "a.exr", "distance"), distance);
}

TEST_F(ImageFiles, TheSameExrHasTheSameBytes) {
    const Image<float> image = ramp(64, 64);
    writeExr(folder_ / "a.exr", {{"V", &image}});
    ::sleep(1); // a stamp of the time of day would differ
    writeExr(folder_ / "b.exr", {{"V", &image}});
    EXPECT_EQ(readFile(folder_ / "a.exr"), readFile(folder_ / "b.exr"));
}

TEST_F(ImageFiles, AnImageThatCannotBeWrittenIsAnErrorAndNoFile) {
    const auto full = [&] { // a process whose files may have no byte
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit none{0, 0};
        setrlimit(RLIMIT_FSIZE, &none);
        const Image<float> image = ramp(4, 4);
        try {
            writeExr(folder_ / "a.exr", {{"V", &image}});
        } catch (const InternalError&) {
            const bool left = !fs::is_empty(folder_);
            fs::remove_all(folder_);
            _exit(left ? 8 : 7);
        }
        _exit(9);
    };
    EXPECT_EXIT(full(), testing::ExitedWithCode(7), "");
}

TEST_F(ImageFiles, APngIsLinearInEightBits) {
    Image<float> image(4, 1);
    image(0, 0) = 0.5F;
    image(1, 0) = 1.5F;
    image(2, 0) = -1.0F;
    image(3, 0) = NAN;
    writePng(folder_ / "a.png", image);
    const Image<float> back = readChannel(folder_ / "a.png", 0);
    EXPECT_FLOAT_EQ(back(0, 0), 128.0F / 255);
    EXPECT_FLOAT_EQ(back(1, 0), 1);
    EXPECT_FLOAT_EQ(back(2, 0), 0);
    EXPECT_FLOAT_EQ(back(3, 0), 0);
}

TEST_F(ImageFiles, AColourPngHasItsChannelsInOrderAndRowZeroAtTheTop) {
    Image<glm::vec3> image(2, 2, glm::vec3(0));
    image(1, 0) = {0.2F, 0.4F, 0.6F};
    writePng(folder_ / "a.png", image);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(readChannel(folder_ / "a.png", channel)(1, 0), 0.2F * static_cast<float>(channel + 1), 0.5 / 255);
    EXPECT_EQ(readChannel(folder_ / "a.png", 0)(1, 1), 0);
}

TEST_F(ImageFiles, WhatIsNotThereIsNamed) {
    const Image<float> image = ramp(3, 3);
    writeExr(folder_ / "a.exr", {{"V", &image}});
    EXPECT_THROW(readChannel(folder_ / "a.exr", 1), BadInput);
    EXPECT_THROW(readChannel(folder_ / "a.exr", -1), BadInput);
    EXPECT_THROW(readChannel(folder_ / "a.exr", "v"), BadInput);
    EXPECT_THROW(readChannel(folder_ / "none.exr", 0), BadInput);
    writeFile(folder_ / "broken.png", "no image");
    EXPECT_THROW(readChannel(folder_ / "broken.png", 0), BadInput);
    writeFile(folder_ / "cut.exr", readFile(folder_ / "a.exr").substr(0, 200));
    EXPECT_THROW(readChannel(folder_ / "cut.exr", 0), BadInput);
}

TEST_F(ImageFiles, ChannelsOfDifferentSizesAreRefusedAndNothingIsLeft) {
    const Image<float> a = ramp(3, 3), b = ramp(3, 4);
    EXPECT_THROW(writeExr(folder_ / "a.exr", {{"a", &a}, {"b", &b}}), InternalError);
    EXPECT_THROW(writePng("/dev/full/a.png", a), InternalError);
    EXPECT_TRUE(fs::is_empty(folder_));
}

} // namespace
} // namespace shadowbench
