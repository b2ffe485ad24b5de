// Files of cards.
#include "gpu/card.h"

#include "base/error.h"

#include <gtest/gtest.h>
#include <string>

namespace shadowbench::gpu {
namespace {

const std::vector<std::string> words{"arithmetic", "texture",    "output",    "output_bytes", "blended_bytes",
                                     "depth",      "tested",     "geometry",  "memory",       "draws",
                                     "passes",     "dependents", "read_backs"};

std::string fileOf(const std::string& left = "", const std::string& source = "a table") {
    std::string text = "name = \"A Card\"\n";
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
    EXPECT_EQ(card[Rate::Arithmetic], 10);
    EXPECT_EQ(card[Rate::Depth], 1e6);
    EXPECT_EQ(card[Rate::ReadBacks], 1e13);
}

TEST(Card, ARateThatIsMissingWrongOrWithoutSourceIsRefused) {
    EXPECT_NE(errorOf(fileOf("texture")).find("texture"), std::string::npos) << errorOf(fileOf("texture"));
    EXPECT_NE(errorOf(fileOf("", "")).find("arithmetic.source: is empty; say where"), std::string::npos)
        << errorOf(fileOf("", ""));
    EXPECT_NE(errorOf(fileOf() + "[textures]\nrate = 1\nsource = \"x\"\n").find("textures"), std::string::npos);
    EXPECT_NE(errorOf(fileOf("depth") + "[depth]\nrate = -1\nsource = \"x\"\n").find("depth.rate"), std::string::npos);
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
