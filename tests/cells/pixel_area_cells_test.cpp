// What cells score against the truth of pixel areas.
#include "base/error.h"
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>
#include <limits>

namespace shadowbench {
namespace {

/// A built-in scene at its gate size with its moving frames.
CellScene& movingScene(const std::string& id) {
    testContext();
    static std::map<std::string, CellScene> scenes;
    if (const auto found = scenes.find(id); found != scenes.end()) return found->second;
    return scenes.try_emplace(id, loadScene(id, Profile::Gate)).first->second;
}

double flicker(const std::string& scene, const std::string& variant) {
    return *movingScene(scene).scored(variant).values["stability.flicker.mean"];
}

/// Against labels at pixel centres, which alias in time, `none` had 0.0138 and 0.0237: images that cannot flicker were
/// charged for the truth's own steps.
TEST(FlickerOfNoShadow, IsTheSmallChangeOfTrueAreasWhereTheCameraAloneMoves) {
    EXPECT_LE(flicker("dueling-frusta", "none"), 0.0075);
    EXPECT_LE(flicker("trees", "none"), 0.013);
}

TEST(FlickerOfNoShadow, IsTheFloorThatEveryRowSays) {
    for (const char* variant : {"none", "sm-uniform"}) {
        const Record& record = movingScene("dueling-frusta").scored(variant);
        ASSERT_TRUE(record.values["stability.flicker.floor"]) << variant;
        EXPECT_NEAR(*record.values["stability.flicker.floor"], flicker("dueling-frusta", "none"), 1e-6) << variant;
    }
}

TEST(Flicker, OfAnExactHardShadowIsMoreThanThatOfItsFilteredImage) {
    // Exact labels crawl along the edges by whole pixels.
    EXPECT_GT(flicker("dueling-frusta", "volume-zfail"), 1.5 * flicker("dueling-frusta", "vsm"));
}

TEST(PixelArea, ScoresEveryRowUnderAPointLightAndNoneUnderAnAreaLight) {
    for (const char* variant : {"none", "sm-uniform", "pcf"}) {
        const Record& record = movingScene("dueling-frusta").scored(variant);
        ASSERT_TRUE(record.pixelReference) << variant;
        EXPECT_EQ(record.pixelReference->oracle, "pixel-areas");
        for (const char* metric : {"pixel_area_rmse", "pixel_area_bad30"})
            EXPECT_TRUE(metrics::bounded(record.values, metric)) << variant << " " << metric;
        EXPECT_TRUE(record.values["accuracy.pixel_area.ssim"]) << variant;
    }
    const Record& underAnAreaLight = stillScene("stacked-plates", 1).scored("sm-uniform");
    EXPECT_FALSE(underAnAreaLight.pixelReference);
    EXPECT_FALSE(underAnAreaLight.values["accuracy.pixel_area.rmse"]);
}

/// Writes one value everywhere.
class Constant : public techniques::Technique {
public:
    explicit Constant(float value) : value_(value) {}
    void render(const techniques::Frame&, const gl::Texture& visibility) override {
        gl::RenderTarget({&visibility}).clearColour(0, glm::vec4(value_));
    }

private:
    float value_;
};

/// What scoring such a technique throws; "" if nothing.
std::string refusalOf(float value) {
    CellScene& cells = stillScene("contact", 1);
    techniques::Variant variant = techniques::parseVariant("none");
    techniques::Entry entry = *variant.entry;
    entry.make = [value](const techniques::Parameters&) { return std::make_unique<Constant>(value); };
    variant.entry = &entry;
    variant.name = "constant:value";
    Record record;
    CellImages images;
    try {
        scoreCell(cells.frames(), variant, 1, record, images);
    } catch (const InternalError& error) {
        return error.what();
    }
    return "";
}

TEST(Answer, OutsideZeroToOneIsRefusedWithTechniqueAndPixel) {
    for (const float bad :
         {1.01F, -0.01F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const std::string refusal = refusalOf(bad);
        EXPECT_NE(refusal.find("constant:value"), std::string::npos) << bad << ": " << refusal;
        EXPECT_NE(refusal.find("at pixel ("), std::string::npos) << bad << ": " << refusal;
    }
    for (const float good : {0.0F, 0.4F, 1.0F, 1.0005F}) EXPECT_EQ(refusalOf(good), "") << good;
}

} // namespace
} // namespace shadowbench
