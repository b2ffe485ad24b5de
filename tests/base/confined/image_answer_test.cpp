// The header of an image from a child that says what it likes: in range, or refused in one line.
#include "base/confined/image_reader.h"
#include "tests/support/hostile_answer.h"

namespace shadowbench {
namespace {

using test::numbers;

std::string answer(const std::string& format = "openexr", std::uint64_t width = 4, std::uint64_t alpha = 0,
                   std::uint64_t flag = 1, std::uint64_t channels = 1, const std::string& name = "Y") {
    return numbers({1, format.size()}) + format + numbers({width, 3, alpha, 32, flag, 1, channels, name.size()}) + name;
}

std::string refusal(const std::string& bytes, ImageHeader* header = nullptr) {
    return test::refusalOf(bytes, [&](ReaderChild& child) {
        const ImageHeader received = receivedHeader(child);
        if (header != nullptr) *header = received;
    });
}

TEST(ImageAnswer, IsTakenAsItIs) {
    ImageHeader header;
    EXPECT_EQ(refusal(answer(), &header), "");
    EXPECT_EQ(header.format, "openexr");
    EXPECT_EQ(header.width, 4);
    EXPECT_EQ(header.height, 3);
    EXPECT_EQ(header.alpha, -1);
    EXPECT_EQ(header.channels, std::vector<std::string>{"Y"});
    EXPECT_TRUE(header.floats && header.whole);
}

TEST(ImageAnswer, ThatEndsAnywhereIsRefused) {
    const std::string whole = answer();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_EQ(refusal(whole.substr(0, length)), "cannot read a.png: its answer ends too early") << length;
}

TEST(ImageAnswer, BeyondABoundIsRefusedBeforeAnythingIsAllocated) {
    const std::uint64_t most = ~std::uint64_t{0};
    for (const std::string& bytes : {answer("openexr", most), answer("openexr", 4, most), answer("openexr", 4, 0, 2),
                                     answer("openexr", 4, 0, 1, most), numbers({1, most}), numbers({2}), numbers({0, most}),
                                     answer("openexr", 4, 2)}) // one channel, and the second is alpha
        EXPECT_TRUE(refusal(bytes).starts_with("cannot read a.png: its ")) << refusal(bytes);
}

TEST(ImageAnswer, DoesNothingToATerminal) {
    EXPECT_EQ(refusal(numbers({0, 9}) + "a\nb\x1b[31m\t"), "cannot read a.png: a b [31m");
    EXPECT_EQ(refusal(numbers({0, 3}) + "a\x7f"
                                        "b"),
              "cannot read a.png: a b");
    EXPECT_EQ(refusal(numbers({0, 2}) + "\n\n"), "cannot read a.png: ");
    ImageHeader header;
    EXPECT_EQ(refusal(answer("png", 4, 0, 1, 1, "Y\x1b[2J\n"), &header), "");
    EXPECT_EQ(header.channels, std::vector<std::string>{"Y [2J"});
}

} // namespace
} // namespace shadowbench
