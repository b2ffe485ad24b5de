// Files of cards.
#include "gpu/card.h"

#include "base/error.h"

#include <gtest/gtest.h>
#include <string>

namespace shadowbench::gpu {
namespace {

const std::vector<std::string> words{"arithmetic",    "clock",  "texture",    "output",    "output_bytes",
                                     "blended_bytes", "depth",  "tested",     "geometry",  "memory",
                                     "draws",         "passes", "dependents", "read_backs"};

std::string fileOf(const std::string& left = "", const std::string& source = "a table", int lanes = 64) {
    std::string text = "name = \"A Card\"\nlanes = " + std::to_string(lanes) + "\n";
    double rate = 1;
    for (const std::string& word : words) {
        rate *= 10;
        if (word != left) text += "[" + word + "]\nrate = " + std::to_string(rate) + "\nsource = \"" + source + "\"\n";
    }
    return text;
}

std::string errorOf(const std::string& text) {
    try {
        (void)parseCard(text, "folder/my-card.toml");
    } catch (const BadInput& error) {
        return error.what();
    }
    return "no error";
}

TEST(Card, HasTheRatesOfItsFileAndItsNameFromIt) {
    const Card card = parseCard(fileOf(), "folder/my-card.toml");
    EXPECT_EQ(card.id, "my-card");
    EXPECT_EQ(card.name, "A Card");
    EXPECT_EQ(card.lanes, 64);
    EXPECT_EQ(card[Rate::Arithmetic], 10);
    EXPECT_EQ(card[Rate::Depth], 1e7);
    EXPECT_EQ(card[Rate::ReadBacks], 1e14);
}

TEST(Card, ARateThatIsMissingWrongOrWithoutSourceIsRefused) {
    EXPECT_NE(errorOf(fileOf("texture")).find("texture"), std::string::npos) << errorOf(fileOf("texture"));
    EXPECT_NE(errorOf(fileOf("", "")).find("arithmetic.source: is empty; say where"), std::string::npos)
        << errorOf(fileOf("", ""));
    EXPECT_NE(errorOf(fileOf() + "[textures]\nrate = 1\nsource = \"x\"\n").find("textures"), std::string::npos);
    EXPECT_NE(errorOf(fileOf("depth") + "[depth]\nrate = -1\nsource = \"x\"\n").find("depth.rate"), std::string::npos);
}

TEST(Card, WavesAreOf32Or64Lanes) {
    EXPECT_EQ(parseCard(fileOf("", "x", 32), "a.toml").lanes, 32);
    EXPECT_NE(errorOf(fileOf("", "x", 48)).find("lanes: is neither 32 nor 64"), std::string::npos)
        << errorOf(fileOf("", "x", 48));
}

TEST(Card, TheBuiltInOnesAreReadAndNamed) {
    EXPECT_EQ(cardNamed("h200").name, "NVIDIA H200");
    EXPECT_EQ(cardNamed("geforce-7600-gt")[Rate::Texture], 6.72e9);
    EXPECT_EQ(cards().size(), 5U);
    try {
        (void)cardNamed("h20");
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("h200"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace shadowbench::gpu
