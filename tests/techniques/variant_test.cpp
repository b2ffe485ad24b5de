// Parameters and variant strings: what is accepted, what is said of the rest.
#include "base/error.h"
#include "base/files.h"
#include "techniques/catalog.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::techniques {
namespace {

std::string refusal(const std::string& variant) {
    try {
        parseVariant(variant);
    } catch (const BadInput& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Variant, DefaultsAreLeftOutAndOrderIsTheDeclaredOne) {
    EXPECT_EQ(parseVariant("pcss").name, "pcss");
    EXPECT_EQ(parseVariant("pcss:map=2048,taps=32+32").name, "pcss:taps=32+32,map=2048");
    EXPECT_EQ(parseVariant("pcss:map=1024,taps=16+16").name, "pcss");
    EXPECT_EQ(parseVariant("pcss:map=01024").name, "pcss");
}

TEST(Catalogue, TheFrontPageCountsItsTechniques) {
    const std::string page = readFile(std::string(SOURCE_FOLDER) + "/README.md");
    EXPECT_NE(page.find("runs " + std::to_string(catalog().size()) + " shadow and level-of-detail techniques"),
              std::string::npos);
}

TEST(Variant, UnknownTechniqueNamesTheNearMatch) {
    EXPECT_NE(refusal("psss").find("pcss"), std::string::npos);
    EXPECT_NE(refusal("psss").find("no technique \"psss\""), std::string::npos);
}

TEST(Variant, UnknownParameterNamesTheValidOnes) {
    const std::string sentence = refusal("sm-uniform:maps=512");
    EXPECT_NE(sentence.find("no parameter \"maps\""), std::string::npos);
    EXPECT_NE(sentence.find("map, bias, factor, units"), std::string::npos);
}

TEST(Variant, ValuesOutOfRangeNameTheRange) {
    EXPECT_NE(refusal("sm-uniform:map=9999999").find("16…8192"), std::string::npos);
    EXPECT_NE(refusal("sm-uniform:map=-1").find("16…8192"), std::string::npos);
    EXPECT_NE(refusal("sm-uniform:map=5x").find("16…8192"), std::string::npos);
    EXPECT_NE(refusal("sm-uniform:bias=big").find("none|constant|slope"), std::string::npos);
    EXPECT_NE(refusal("sm-history:m=nan").find("not allowed"), std::string::npos);
    EXPECT_NE(refusal("sm-history:m=inf").find("not allowed"), std::string::npos);
}

TEST(Variant, HalfAnAssignmentAndARepeatedOneAreRefused) {
    EXPECT_NE(refusal("pcss:taps").find("needs a value"), std::string::npos);
    EXPECT_NE(refusal("pcss:map=64,map=128").find("twice"), std::string::npos);
}

TEST(Parameters, OfEachDomainAreTakenWithinItAlone) {
    const std::vector<Parameter> declared{{"m", "0.5", RealRange{0.25, 4}, "", ""}, {"n", "2", IntegerRange{1, 8}, "", ""}};
    const auto taken = [&](const std::string& words) {
        try {
            const Parameters parameters = parseParameters(words, declared, "t");
            return canonicalVariant("t", parameters, declared);
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(taken("m=0.25,n=8"), "t:m=0.25,n=8");
    EXPECT_EQ(taken("m=4.0"), "t:m=4");
    for (const std::string value : {"0.2", "4.1", "x", "1x", ""})
        EXPECT_EQ(taken("m=" + value), "technique t: m=" + value + " is not allowed; valid: 0.25…4");
    for (const std::string value : {"0", "9", "x", "1x", "1.5", "99999999999", ""})
        EXPECT_EQ(taken("n=" + value), "technique t: n=" + value + " is not allowed; valid: 1…8");
    EXPECT_EQ(parseParameters("m=2", declared, "t").real("m"), 2);
    EXPECT_EQ(parseParameters("m=2", declared, "t").integer("n"), 2);
}

TEST(Parameters, ThatATechniqueAsksForAsWhatTheyAreNotAreAnErrorOfOurs) {
    const Parameters parameters(std::vector<std::pair<std::string, std::string>>{{"filter", "box"}});
    EXPECT_THROW((void)parameters.integer("filter"), InternalError);
    EXPECT_THROW((void)parameters.real("filter"), InternalError);
    EXPECT_THROW((void)parameters.text("fitler"), InternalError);
    EXPECT_EQ(parameters.text("filter"), "box");
}

TEST(Variant, GlobsGiveEveryShownVariantOfEachMatch) {
    std::set<std::string> names;
    for (const Variant& variant : matchVariants("sm-c*")) names.insert(variant.name);
    EXPECT_EQ(names, (std::set<std::string>{"sm-cascaded", "sm-cascaded:fit=view,lambda=0.5",
                                            "sm-cascaded:slices=2,warp=lispsm", "sm-clipmap", "sm-cube"}));
    EXPECT_THROW(matchVariants("zz*"), BadInput);
}

TEST(Variant, HistoryIsComparedWithItsOwnBaseAtTheSameMapSize) {
    EXPECT_EQ(costBase(parseVariant("sm-history:map=512"))->name, "sm-lispsm:map=512");
    EXPECT_EQ(costBase(parseVariant("sm-history:base=uniform"))->name, "sm-uniform");
    EXPECT_FALSE(costBase(parseVariant("pcss")));
}

TEST(Catalogue, IdsAreUniqueAndEveryShownVariantIsCanonical) {
    std::set<std::string> ids;
    for (const Entry& entry : catalog()) {
        EXPECT_TRUE(ids.insert(entry.id).second) << entry.id;
        EXPECT_FALSE(entry.variants.empty()) << entry.id;
        for (const std::string& shown : entry.variants) {
            const std::string text = shown.empty() ? entry.id : entry.id + ":" + shown;
            EXPECT_EQ(parseVariant(text).name, text);
        }
    }
}

TEST(Figures, OnlyDeclaredFiniteOnesAreReported) {
    Entry entry;
    entry.id = "counting";
    entry.figures = {{"tiles", "tiles drawn"}, {"passes", "passes over the scene"}};
    EXPECT_EQ(declaredFigures(entry, {}), (std::map<std::string, double>{}));
    EXPECT_EQ(declaredFigures(entry, {{"tiles", 6}}), (std::map<std::string, double>{{"tiles", 6}}));
    const auto complaint = [&](const std::map<std::string, double>& figures) -> std::string {
        try {
            declaredFigures(entry, figures);
        } catch (const InternalError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(complaint({{"tiles", 6}, {"tlies", 6}}),
              "technique counting reports a figure \"tlies\" that its catalogue entry does not declare");
    EXPECT_NE(complaint({{"passes", std::nan("")}}).find("its figure \"passes\" is nan"), std::string::npos);
}

TEST(Figures, AreDeclaredOnceWithAMeaning) {
    for (const Entry& entry : catalog()) {
        std::set<std::string> names;
        for (const Figure& figure : entry.figures) {
            EXPECT_TRUE(names.insert(figure.name).second) << entry.id << " " << figure.name;
            EXPECT_FALSE(figure.meaning.empty()) << entry.id << " " << figure.name;
        }
    }
}

} // namespace
} // namespace shadowbench::techniques
