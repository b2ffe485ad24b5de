// Pages on the truth: numbers, pictures and charts of references that no oracle made.
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "report/truth_figures.h"
#include "report/truth_report.h"

#include <gtest/gtest.h>
#include <limits>
#include <regex>

namespace shadowbench::report {
namespace {

namespace fs = std::filesystem;
using groundtruth::Reference;
using groundtruth::Surface;

/// Two rows of four pixels. Above: background, facing away, on an edge, receiver in full light far from every edge. Below:
/// receivers that see 0, 0, ¼ and all of the light.
Reference example(bool soft) {
    constexpr float far = std::numeric_limits<float>::infinity();
    Reference r;
    r.surface = Image<Surface>(4, 2, Surface::Receiver);
    r.surface(0, 0) = Surface::Background;
    r.surface(1, 0) = Surface::FacesAway;
    r.surface(2, 0) = Surface::OnEdge;
    r.visibility = r.sigma = Image<float>(4, 2);
    r.edgeDistance = Image<float>(4, 2, far);
    r.id = Image<std::uint32_t>(4, 2, 1);
    r.visibility(3, 0) = r.visibility(3, 1) = 1;
    r.visibility(2, 1) = soft ? 0.25F : 0;
    r.provenance = {"polygon", "0123456789abcdef0123456789abcdef", 0, {{"exact", "2"}}, 0.25, {}};
    if (!soft) {
        r.edgeDistance(0, 1) = 4;
        r.edgeDistance(2, 1) = r.edgeDistance(3, 1) = 0.5F;
        return r;
    }
    r.sigma(1, 1) = 0.01F;
    r.sigma(2, 1) = 0.04F;
    r.provenance = {"povray", "fedcba9876543210fedcba9876543210", 256, {{"povray", "3.7"}}, 12, {{"light_mismatch", 0.002}}};
    return r;
}

TruthOfScene areaScene() {
    return {"plates",
            "Plates | bars",
            "penumbrae that overlap",
            "gate",
            59,
            {{"hard", example(false)}, {"soft", example(true)}},
            {{"polygon", "rays", "planar receivers", 5, 0, 1, 0, 0.05, 0.1}}};
}

TruthOfScene pointScene() { return {"frusta with space", "Frusta", "aliasing", "gate", 59, {{"hard", example(false)}}, {}}; }

/// With what the same pixels see on average.
ShownReference pixelAreas() {
    Reference r = example(false);
    r.surface(2, 0) = Surface::Receiver;
    r.visibility(2, 0) = 0.5F;
    r.visibility(2, 1) = 0.375F;
    r.sigma(2, 1) = 0.008F;
    r.provenance = {"pixel-areas", "00112233445566778899aabbccddeeff", 0, {{"exact", "2"}}, 3, {{"certificate_rms", 0.004}}};
    return {"pixel-area", r};
}

TEST(TruthNumbers, CountLabelsEdgesAndUncertainty) {
    const TruthNumbers hard = truthNumbers(example(false)), soft = truthNumbers(example(true));
    EXPECT_EQ(hard.receivers, 5U);
    EXPECT_EQ(hard.shadowed, 3U);
    EXPECT_EQ(hard.penumbra, 0U);
    EXPECT_EQ(hard.onEdge, 1U);
    EXPECT_EQ(hard.edgePixels, 2U);
    EXPECT_EQ(hard.sigmaLargest, 0);
    EXPECT_EQ(soft.shadowed, 2U);
    EXPECT_EQ(soft.penumbra, 1U);
    EXPECT_FLOAT_EQ(static_cast<float>(soft.sigmaLargest), 0.04F);
}

TEST(TruthPictures, ShowValuesAsGreyAndOtherSurfacesInColour) {
    const Image<glm::vec3> visibility = visibilityPicture(example(true));
    EXPECT_EQ(visibility(2, 1), glm::vec3(0.25F));
    EXPECT_EQ(visibility(3, 1), glm::vec3(1));
    for (int x = 0; x < 3; ++x) { // three surfaces, three colours, none of them grey
        EXPECT_NE(visibility(x, 0).x, visibility(x, 0).z);
        EXPECT_NE(visibility(x, 0), visibility((x + 1) % 3, 0));
    }
    EXPECT_EQ(sigmaPicture(example(true), 0.04F)(2, 1), glm::vec3(1));
    EXPECT_EQ(sigmaPicture(example(true), 0.04F)(0, 1), glm::vec3(0));
    EXPECT_EQ(sigmaPicture(example(false), 0)(0, 1), glm::vec3(0));
    EXPECT_EQ(edgeDistancePicture(example(false))(0, 1), glm::vec3(0.5F)); // 4 of 8 pixels
    EXPECT_EQ(edgeDistancePicture(example(false))(3, 0), glm::vec3(1));
}

class TruthReport : public testing::Test {
protected:
    [[nodiscard]] std::string text(const std::string& file) const { return readFile(folder_.path() / file); }
    TemporaryFolder folder_;
};

TEST_F(TruthReport, EveryRelativeLinkLeadsToAFileThatWasWritten) {
    const Written written = writeTruthReport({areaScene(), pointScene()}, folder_.path());
    EXPECT_EQ(written.page, folder_.path() / "report.md");
    const std::regex link(R"(\]\(<?([^)>]+)>?\))");
    int links = 0;
    for (const char* page : {"report.md", "plates.md", "frusta with space.md"}) {
        const std::string content = text(page);
        for (std::sregex_iterator found(content.begin(), content.end(), link), end; found != end; ++found, ++links)
            EXPECT_TRUE(fs::is_regular_file(folder_.path() / (*found)[1].str())) << page << ": " << (*found)[1];
    }
    EXPECT_EQ(links, 3 + 1 + 6 + 4); // index: a row a reference and its chart; pages: back, pictures and histograms
    for (const fs::path& chart : written.charts) EXPECT_TRUE(fs::is_regular_file(chart)) << chart;
}

TEST_F(TruthReport, PagesTellProvenanceUncertaintyAndAgreement) {
    writeTruthReport({areaScene(), pointScene()}, folder_.path());
    const std::string page = text("plates.md");
    for (const char* part :
         {"Plates \\| bars", "| oracle | polygon | povray |", "| light samples | – | 256 |", "| receiver pixels | 5 | 5 |",
          "| of them fully shadowed | 60.0 % | 40.0 % |", "| of them within ½ px of an edge | 40.0 % | – |",
          "| measured: light\\_mismatch | – | 0.002 |", "0123456789abcdef0123456789abcdef", "white = 0.04",
          "| polygon, rays | planar receivers | 5 | 0 | 1 | 0 | 0.05, 0.1 |"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\nin " << page;
    EXPECT_NE(text("frusta with space.md").find("No two oracles apply."), std::string::npos);
    EXPECT_NE(text("report.md").find("polygon, rays: 0 of 5 differ"), std::string::npos) << text("report.md");
}

TEST_F(TruthReport, ShowsPixelAreasAndTheirSigmaBesideTheOthers) {
    TruthOfScene scene = areaScene();
    scene.references.push_back(pixelAreas());
    writeTruthReport({scene}, folder_.path());
    const std::string page = text("plates.md");
    for (const char* part :
         {"## The pixel-area truth", "C\\*, the mean over the pixel", "white = 0.008",
          "| oracle | polygon | povray | pixel-areas |", "| of them partly lit | 0.00 % | 20.0 % | 33.3 % |",
          "| measured: certificate\\_rms | – | – | 0.004 |"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\nin " << page;
    EXPECT_NEAR(readChannel(folder_.path() / "plates-pixel-area-visibility.png", 0)(2, 1), 0.375, 0.5 / 255);
    EXPECT_EQ(readChannel(folder_.path() / "plates-pixel-area-sigma.png", 0)(2, 1), 1);
    const std::string charts = histograms(scene);
    for (const char* title : {"σ* of the soft truth", "σ* of the pixel-area truth"})
        EXPECT_NE(charts.find(title), std::string::npos) << title;
}

TEST_F(TruthReport, PicturesHoldTheReference) {
    writeTruthReport({areaScene()}, folder_.path());
    const Image<float> red = readChannel(folder_.path() / "plates-soft-visibility.png", 0);
    EXPECT_NEAR(red(2, 1), 0.25, 0.5 / 255); // eight bits
    EXPECT_EQ(red(3, 1), 1);
    EXPECT_FALSE(fs::exists(folder_.path() / "plates-hard-sigma.png")); // exact: σ is 0
}

TEST_F(TruthReport, OfTheSameTruthIsTheSameByteForByte) {
    writeTruthReport({areaScene()}, folder_.path() / "a");
    writeTruthReport({areaScene()}, folder_.path() / "b");
    for (const auto& file : fs::directory_iterator(folder_.path() / "a"))
        EXPECT_EQ(readFile(file.path()), readFile(folder_.path() / "b" / file.path().filename())) << file.path();
}

TEST(TruthCharts, NameTheirAxesAndSeries) {
    const std::string chart = histograms(areaScene());
    EXPECT_NE(chart.find("distance to the nearest hard shadow edge"), std::string::npos);
    EXPECT_NE(chart.find("σ*"), std::string::npos);
    EXPECT_EQ(histograms(pointScene()).find("σ*"), std::string::npos);
    const std::string seconds = secondsChart({areaScene(), pointScene()});
    for (const char* part : {"plates", "frusta with space", "polygon, planar receivers", "soft reference"})
        EXPECT_NE(seconds.find(part), std::string::npos) << part;
}

} // namespace
} // namespace shadowbench::report
