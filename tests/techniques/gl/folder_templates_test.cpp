// The technique folders that `new-technique` writes: the bits of the built-in rows, or closed forms.
#include "techniques/folder/templates.h"
#include "tests/support/filtered_scenes.h"
#include "tests/support/soft_scenes.h"
#include "tests/support/technique_folders.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class FromTemplate {
public:
    explicit FromTemplate(const std::string& like) { techniques::writeFromTemplate(like, "mine", folder_.path() / "mine"); }

    techniques::Entry entry() const {
        return techniques::folderEntry(techniques::readTechniqueFolder(folder_.path() / "mine"));
    }

    Image<float> drawn(Stage& stage, const std::string& parameters = "", int frames = 1) const {
        const techniques::Entry made = entry();
        const auto technique = made.make(techniques::parseParameters(parameters, made.parameters, made.id));
        for (int frame = 0; frame < frames; ++frame) stage.render(*technique, frame, 1);
        return stage.visibility();
    }

private:
    TemporaryFolder folder_;
};

void expectBitsOf(const std::string& builtIn, const std::string& like, const std::string& parameters) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const Image<float> mine = FromTemplate(like).drawn(stage, parameters),
                       theirs = rendered(stage, builtIn + ":" + parameters);
    for (std::size_t i = 0; i < mine.size(); ++i)
        ASSERT_EQ(mine[i], theirs[i]) << like << " " << parameters << ", pixel " << i;
}

TEST(FolderTemplate, ShadowMapDrawsTheBitsOfTheUniformMap) {
    for (const char* parameters : {"", "map=64"}) expectBitsOf("sm-uniform", "shadow-map", parameters);
}

TEST(FolderTemplate, PcfDrawsTheBitsOfPercentageCloserFiltering) {
    for (const char* parameters : {"", "kernel=7"}) expectBitsOf("pcf", "pcf", parameters);
}

// Of an occluder and a receiver that are parallel to the map, Chebyshev's bound is the lit share of the kernel.
TEST(FolderTemplate, VsmMakesAnEdgeARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const FromTemplate vsm("vsm");
    for (const int kernel : {3, 7}) {
        const auto points = groundPoints(stage, vsm.drawn(stage, "map=256,kernel=" + std::to_string(kernel)));
        EXPECT_LT(fromRamp(points, kernel * texelOf(scene, 256)), 0.03) << kernel; // the ground's pixels are finite
        for (const GroundPoint& point : points) ASSERT_LT(point.at.x > edgeAt + 0.4 ? point.visibility : 0, 1e-4);
    }
}

// The second example of docs/technique-folders.md. Between the means of texels of a level, which the edge cuts anywhere, an
// edge is a ramp of one to two of them.
TEST(DocumentedFolder, MomentsMakeAnEdgeARampOfTheLevelsTexels) {
    const WrittenTechnique moments(documentedBlocks("toml").at(1), documentedBlocks("glsl").at(2));
    moments.write("moments.frag", documentedBlocks("glsl").at(1));
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const int level : {2, 3}) {
        const auto technique = moments.made("map=512,level=" + std::to_string(level));
        stage.render(*technique, 0, 1);
        const auto points = groundPoints(stage, stage.visibility());
        EXPECT_LT(fromRamp(points, 1.5 * (1 << level) * texelOf(scene, 512)), 0.2) << level;
        for (const GroundPoint& point : points) ASSERT_LT(point.at.x > edgeAt + 0.4 ? point.visibility : 0, 1e-4);
    }
}

TEST(FolderTemplate, HistoryIsTheMeanOverPointsOfTheLight) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const FromTemplate history("history");
    EXPECT_TRUE(history.entry().temporal);
    constexpr double hardError = 0.5 / 1.7320508; // of 0 or 1 for a ramp
    const auto one = slabPoints(stage, history.drawn(stage));
    EXPECT_GT(penumbraRmsError(one), 0.9 * hardError);
    const Image<float> many = history.drawn(stage, "", 64);
    for (std::size_t i = 0; i < many.size(); ++i) ASSERT_NEAR(64 * many[i], std::round(64 * many[i]), 1e-3) << "pixel " << i;
    EXPECT_LT(penumbraRmsError(slabPoints(stage, many)), 0.03); // Halton's points, of which 64 are evenly spread
    EXPECT_GT(penumbraRmsError(slabPoints(stage, history.drawn(stage, "frames=2", 64))), 0.1);
}

} // namespace
} // namespace shadowbench
