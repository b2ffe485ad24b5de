// `shadowbench reference` as a user asks one oracle or another.
#include "base/files.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

class Reference : public testing::Test {
protected:
    [[nodiscard]] Outcome reference(const std::string& options) const {
        return shell("shadowbench reference --quiet --out " + folder_ / "out" + " " + options);
    }
    [[nodiscard]] std::string provenance() const { return readFile(folder_ / "out/provenance.json"); }

    Folder folder_;
    std::string point_ = folder_.write("point.toml", tinyScene());
    std::string area_ = folder_.write(
        "area.toml",
        tinyScene("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [1.1, 0, 0.2], v = [-0.2, 0, 1.1] }"));
    std::string sky_ = folder_.write("sky.toml", tinyScene("{ kind = \"environment\", sky = { constant = 1 } }"));
};

TEST_F(Reference, WritesVisibilityAndProvenance) {
    const Outcome outcome = reference("--scene " + point_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/visibility.exr"));
    EXPECT_TRUE(nlohmann::json::parse(provenance()).contains("oracle"));
}

TEST_F(Reference, OfAnAreaLightIsExactByTheAreaOracle) {
    const Outcome outcome = reference("--truth area --scene " + area_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(provenance());
    EXPECT_EQ(json["oracle"], "area");
    EXPECT_FALSE(json["tools"].contains("povray"));
    EXPECT_TRUE(json["tools"].contains("area"));
}

TEST_F(Reference, CertifyMeasuresPovRayAgainstTheExactFraction) {
    const Outcome outcome =
        shell("shadowbench reference --quiet --certify --points 500 --json --samples 256 --scene " + area_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["samples"], 256);
    EXPECT_GT(json["certificate_penumbra"], 50); // a ring of two pixels around a shadow in an image of 48²
    EXPECT_EQ(json["certificate_wrong"], 0);
    EXPECT_LT(json["certificate_rms"], 0.01); // a net of 256 points errs by some 1/256
    EXPECT_LT(json["certificate_rms"], json["certificate_rms_quarter"]);
}

TEST_F(Reference, OfASkyIsRenderedAndCertified) {
    const Outcome outcome = reference("--samples 256 --scene " + sky_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(provenance());
    EXPECT_EQ(json["oracle"], "povray");
    EXPECT_TRUE(json["tools"].contains("povray sky"));
    EXPECT_FALSE(json["tools"].contains("area"));
    EXPECT_GE(json["measured"]["certificate_directions"], 16384);

    const Outcome certified = shell("shadowbench reference --quiet --certify --points 64 --samples 256 --scene " + sky_);
    EXPECT_EQ(certified.code, 0) << certified.output;
    EXPECT_NE(certified.output.find("256 directions of the sky against 16384 exact ones"), std::string::npos)
        << certified.output;
}

TEST_F(Reference, OfASkyHasNoHardShadowAndNoPolygons) {
    for (const std::string options : {"--oracle rays", "--oracle area", "--samples 256 --polygons"}) {
        const Outcome outcome = reference(options + " --scene " + sky_);
        EXPECT_EQ(outcome.code, 2) << options;
        EXPECT_NE(outcome.output.find("environment"), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(shell("shadowbench reference --quiet --verify --truth hard --scene " + sky_).code, 2);
}

TEST_F(Reference, PolygonsAreWrittenOnRequest) {
    const Outcome outcome = reference("--polygons --scene " + point_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(readFile(folder_ / "out/shadow-1.wkt").rfind("MULTIPOLYGON (((", 0), 0U);
    EXPECT_NE(readFile(folder_ / "out/shadow-1.svg").find("</svg>"), std::string::npos);
    EXPECT_NE(outcome.output.find("shadow-1.svg"), std::string::npos) << outcome.output;
}

TEST_F(Reference, ByPlanRefusesASceneThatIsNotOne) {
    const Outcome outcome = reference("--oracle plan --scene " + point_); // a box that floats
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Reference, ByPlanComesWithWhatTheLightSees) {
    const Outcome outcome = reference("--oracle plan --polygons --scene colonnade");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(nlohmann::json::parse(provenance())["oracle"], "plan");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/shadow-1.wkt"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/visible-1.wkt"));
}

TEST_F(Reference, AFormerNameOfATruthIsStillRead) {
    const Outcome outcome = reference("--oracle area --scene " + area_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("--oracle area is now called --truth area"), std::string::npos) << outcome.output;
    EXPECT_EQ(nlohmann::json::parse(provenance())["oracle"], "area");
}

TEST_F(Reference, OfAnAreaLightsCentreIsFoundByTheOracleThatIsNamed) {
    const Outcome outcome = reference("--oracle rays --scene " + area_);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(nlohmann::json::parse(provenance())["oracle"], "rays");
}

TEST_F(Reference, TruthsThatTheLightDoesNotHaveAreNamed) {
    EXPECT_EQ(reference("--truth area --scene " + point_).code, 2);
    EXPECT_EQ(reference("--oracle plan --scene " + area_).code, 2);
    EXPECT_EQ(shell("shadowbench reference --certify --scene " + point_).code, 2);
}

} // namespace
} // namespace shadowbench
