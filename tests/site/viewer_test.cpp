// What the viewer is given: shadow edges, packed values, pictures.
#include "base/files.h"
#include "base/image_io.h"
#include "base/srgb.h"
#include "base/temporary_folder.h"
#include "site/viewer/cell_data.h"
#include "site/viewer/cells.h"
#include "site/viewer/pixel_script.h"
#include "site/viewer/shadow_edges.h"
#include "tests/support/report_examples.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

constexpr int side = 16;
const glm::vec2 normal = glm::normalize(glm::vec2(0.8F, -0.3F));
constexpr float offset = 5.4F;

/// The signed distance from a straight edge.
float distanceAt(int x, int y) { return glm::dot(normal, glm::vec2(x, y) + 0.5F) - offset; }

/// Lit on one side of the edge; one surface, all of it receiver.
KeptTruth halfPlane() {
    KeptTruth truth{Image<float>(side, side), Image<float>(side, side), Image<float>(side, side, 2),
                    Image<float>(side, side), Image<float>(side, side, 1)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            truth.visibility(x, y) = distanceAt(x, y) > 0 ? 1 : 0;
            truth.edgeDistance(x, y) = std::abs(distanceAt(x, y));
        }
    return truth;
}

TEST(ShadowEdges, OfAHalfPlaneLieOnItsStraightEdge) {
    const std::vector<float> edges = shadowEdges(halfPlane());
    ASSERT_GE(edges.size(), 4U * 10U);
    for (std::size_t i = 0; i < edges.size(); i += 2)
        EXPECT_NEAR(glm::dot(normal, glm::vec2(edges[i], edges[i + 1])), offset, 1e-4) << i;
}

TEST(ShadowEdges, EndWhereTheSurfaceEndsOrNothingIsScored) {
    KeptTruth truth = halfPlane();
    for (int x = 0; x < side; ++x) {
        truth.id(x, 3) = 2;
        truth.surface(x, 10) = 0;
    }
    const std::vector<float> edges = shadowEdges(truth);
    EXPECT_LT(edges.size(), shadowEdges(halfPlane()).size());
    for (std::size_t i = 0; i < edges.size(); i += 4) {
        EXPECT_FALSE(edges[i + 1] > 2.5F && edges[i + 1] < 4.5F && edges[i + 3] > 2.5F && edges[i + 3] < 4.5F &&
                     std::abs(edges[i + 3] - edges[i + 1]) > 0.01F);
        EXPECT_FALSE(edges[i + 1] > 9.5F && edges[i + 1] < 11.5F);
    }
}

TEST(ShadowEdges, AreWhereHalfTheLightIsSeenIfThereAreNoDistances) {
    KeptTruth truth = halfPlane();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            truth.edgeDistance(x, y) = std::numeric_limits<float>::infinity();
            truth.visibility(x, y) = 0.5F + 0.01F * distanceAt(x, y);
        }
    EXPECT_FALSE(hasExactEdges(truth));
    const std::vector<float> edges = shadowEdges(truth);
    ASSERT_GE(edges.size(), 4U * 10U);
    for (std::size_t i = 0; i < edges.size(); i += 2)
        EXPECT_NEAR(glm::dot(normal, glm::vec2(edges[i], edges[i + 1])), offset, 1e-3) << i;
}

TEST(PixelScript, CallsTheViewerWithItsNameAndChannels) {
    const std::string script = pixelScript("simple/a\"b", {{"V", {0, 0.5F, 1}}});
    EXPECT_TRUE(script.starts_with(R"(shadowbench.pixels("simple/a\"b", {"V":")")) << script;
    EXPECT_EQ(packed({0, 0.5F, 1}), packed({0, 0.5F, 1}));
    EXPECT_NE(packed({0, 0.5F, 1}), packed({0, 0.5F, std::nextafter(1.0F, 2.0F)}));
    EXPECT_TRUE(packed({}).ends_with("=") || packed({}).size() % 4 == 0);
}

TEST(PixelScript, OfAFlatImageIsSmall) { EXPECT_LT(packed(std::vector<float>(65536, 1)).size(), 1000U); }

TEST(DifferencePicture, IsOrangeForFalseShadowBlueForLeakAndDarkWhereRight) {
    const KeptTruth truth = halfPlane();
    const glm::ivec2 lit(side - 1, 0), shadowed(0, side - 1);
    Image<float> v = truth.visibility;
    v(lit.x, lit.y) = 0;
    v(shadowed.x, shadowed.y) = 1;
    const Image<glm::vec3> picture = differencePicture(v, truth);
    EXPECT_EQ(picture(lit.x, lit.y), glm::vec3(255, 150, 40) / 255.0F);
    EXPECT_EQ(picture(shadowed.x, shadowed.y), glm::vec3(80, 170, 255) / 255.0F);
    EXPECT_EQ(picture(1, side - 1), glm::vec3(24.0F / 255));
}

TEST(CatalogueScript, HoldsNoEndOfAScriptWhateverTheNames) {
    ShownScene scene{"s", "</script><script>alert(1)", 1, 1, {{"hard", "hard", "s/truth/hard", "p.png", true}}, {}};
    scene.cells.push_back({"c", "\xE2\x80\xA8\xFF", "mismatch 1 %", "hard", "s/c", "p.png", "d.png", {}});
    const std::string script = catalogueScript(scene);
    EXPECT_EQ(script.find('<'), std::string::npos) << script;
    EXPECT_EQ(script.find('\n'), script.size() - 1);
    for (const char letter : script) EXPECT_LT(static_cast<unsigned char>(letter), 0x80U);
}

TEST(HasCell, IsFalseForNamesThatLeadElsewhere) {
    const TemporaryFolder folder;
    const fs::path images = folder.path() / "in/images";
    const Image<float> one(1, 1, 1.0F);
    for (const char* place : {"in/images/scene/pcf", "scene/pcf", "in/images/pcf"})
        writeExr(folder.path() / place / "visibility.exr", {{"V", &one}});
    for (const char* place : {"in/images/scene", "scene", "in/images"})
        writeExr(folder.path() / place / "truth-hard.exr", {{"V", &one}});
    Record record = test::hardCell("pcf", 0.1, 1);
    record.scene = "scene";
    EXPECT_TRUE(hasCell(record, images));
    for (const std::string& scene : {std::string("../../scene"), std::string(".."), std::string("."), std::string(),
                                     std::string(100'000, 'x'), std::string("a\0b", 3)}) {
        record.scene = scene;
        EXPECT_FALSE(hasCell(record, images)) << scene.substr(0, 20);
    }
    record.scene = "scene";
    record.variant = "../../../scene/pcf";
    EXPECT_FALSE(hasCell(record, images));
}

TEST(ShadedPictures, AreWrittenForACellWhoseRunHasKeptTheLight) {
    const TemporaryFolder folder;
    const fs::path images = folder.path() / "images";
    const KeptTruth truth = halfPlane();
    writeExr(truthFile(images, "scene", "hard"), {{"V", &truth.visibility},
                                                  {"sigma", &truth.sigma},
                                                  {"surface", &truth.surface},
                                                  {"edge", &truth.edgeDistance},
                                                  {"id", &truth.id}});
    const Image<float> quarter(side, side, 0.25F);
    writeExr(cellFolder(images, "scene", "pcf") / "visibility.exr", {{"V", &quarter}});
    Record record = test::hardCell("pcf", 0.1, 1);
    record.scene = "scene";
    const RunCell cell{"pcf", record, images};
    SiteWriter site(folder.path() / "site", {});
    writeCells({record}, images, site);
    EXPECT_FALSE(shadedPictures(cell, site)) << "a run of an older program";

    keepShading(shadingFile(images, "scene"), {Image<glm::vec3>(side, side, glm::vec3(0.1F)), Image<float>(side, side, 4)});
    const auto pictures = shadedPictures(cell, site);
    ASSERT_TRUE(pictures);
    const auto shown = [&](const std::string& address, int x) { return readChannel(site.folder() / address, 0)(x, 0); };
    EXPECT_NEAR(shown(pictures->technique, 0), srgbFromLinear(0.1F * (1 + 0.25F * 4)), 0.5 / 255);
    EXPECT_NEAR(shown(pictures->truth, 0), srgbFromLinear(0.1F), 0.5 / 255);
    EXPECT_NEAR(shown(pictures->truth, side - 1), srgbFromLinear(0.5F), 0.5 / 255);
    EXPECT_EQ(pictures->difference, cellPictures(cell, images, site)->difference);
}

} // namespace
} // namespace shadowbench::site
