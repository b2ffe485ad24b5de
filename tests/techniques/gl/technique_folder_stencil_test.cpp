// Stencils of technique folders: masks over the screen, and counts of what lies behind the nearest casters.
#include "tests/support/technique_folders.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench {
namespace {

const std::string kernel = replaced(filteringShader, "KERNEL", "7");

/// Filters with many taps where the pass before did not know.
std::unique_ptr<WrittenTechnique> masked(const std::string& sureStencil, const std::string& filterStencil) {
    const std::string sure =
        "[target.mask]\nformat = \"Depth32FStencil8\"\nsize = \"image\"\n\n[[pass]]\nname = \"sure\"\ndraw = "
        "\"screen\"\nfragment = \"sure.frag\"\nto = [\"visibility\", \"mask\"]\nstencil = { " +
        sureStencil + " }\n\n[[pass]]\nname = \"resolve\"";
    std::string toml = replaced(mapToml, "[[pass]]\nname = \"resolve\"", sure);
    toml = replaced(toml, "to = \"visibility\"\n", "to = [\"visibility\", \"mask\"]\nstencil = { " + filterStencil + " }\n");
    auto folder = std::make_unique<WrittenTechnique>(toml, kernel);
    folder->write("sure.frag", "#include \"gl/receiver.glsl\"\nout float visibility;\nvoid main() { Receiver receiver = "
                               "receiverAt(gl_FragCoord.xy);\n if (receiver.seen) discard;\n visibility = 0.25; }\n");
    return folder;
}

Image<float> drawn(Stage& stage, const WrittenTechnique& folder, int frames = 2) {
    const auto technique = folder.made();
    for (int frame = 0; frame < frames; ++frame) stage.render(*technique, frame, 1); // the stencil is new in each
    return stage.visibility();
}

TEST(FolderStencil, AMaskLeavesTheFilterToThePixelsThatNeedIt) {
    const Scene scene = boxScene(64); // which has background at its rim
    Stage stage(scene);
    stage.show(0);
    const Image<glm::vec4> positions = gl::RenderTarget({&stage.frame(0, 1).gbuffer.position()}).readVec4(0);
    const Image<float> all = drawn(stage, WrittenTechnique(mapToml, kernel));
    const Image<float> mine = drawn(stage, *masked("pass = \"replace\", ref = 1", "test = \"not-equal\", ref = 1"));
    // The other way round, where nothing is marked, no receiver is filtered.
    rendered(stage, "none");
    const Image<float> none = drawn(stage, *masked("pass = \"keep\"", "test = \"equal\", ref = 1"));
    int background = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool seen = positions[i].w > 0;
        background += seen ? 0 : 1;
        ASSERT_EQ(mine[i], seen ? all[i] : 0.25F) << i;
        ASSERT_EQ(none[i], seen ? 1.0F : 0.25F) << i;
    }
    EXPECT_GT(background, 100);
    EXPECT_LT(*std::ranges::min_element(all), 0.5F);
}

/// The visibility of what the last pass finds in the stencil: 1 where it is `reference`.
float counted(const std::string& passes, int reference) {
    const std::string more =
        "[target.counts]\nformat = \"Depth32FStencil8\"\nsize = \"map\"\n\n[target.found]\nformat = \"R32F\"\n"
        "size = \"map\"\n\n" +
        passes +
        fmt::format("[[pass]]\nname = \"found\"\ndraw = \"screen\"\nfragment = \"one.frag\"\nto = [\"found\", "
                    "\"counts\"]\nblend = \"add\"\nclear = [0, 0, 0, 0]\nstencil = {{ test = \"equal\", ref = {} "
                    "}}\n\n",
                    reference);
    const std::string last = "[[pass]]\nname = \"resolve\"";
    const WrittenTechnique folder(replaced(mapToml, last, more + last),
                                  "uniform sampler2D found;\nout float visibility;\nvoid main() { visibility = "
                                  "texelFetch(found, textureSize(found, 0) / 2, 0).r; }\n");
    folder.write("one.frag", "out float one;\nvoid main() { one = 1.0; }\n");
    Scene scene = boxScene(32);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    Stage stage(scene);
    stage.show(0);
    return drawn(stage, folder)(5, 5);
}

std::string casters(const std::string& keys) {
    return "[[pass]]\nname = \"counts\"\ndraw = \"casters\"\nto = \"counts\"\n" + keys + "\n\n";
}

// Of a box over a slab, both closed and in the middle of the map: four faces one over the other.
TEST(FolderStencil, CountsCastersWhereTheDepthTestPassesAndWhereItFails) {
    const std::string nearest = casters("");
    const auto behind = [&](const std::string& operation) {
        return nearest +
               "[target.layers]\nformat = \"R32F\"\nsize = \"map\"\n\n[[pass]]\nname = \"behind\"\ndraw = \"casters\"\n" +
               "fragment = \"one.frag\"\nto = [\"layers\", \"counts\"]\npeel = true\nblend = \"add\"\nstencil = { " +
               operation + " }\n\n";
    };
    EXPECT_EQ(counted(nearest, 0), 1);
    EXPECT_EQ(counted(behind("pass = \"increment\""), 3), 1);       // behind the nearest
    EXPECT_EQ(counted(behind("depth_fail = \"increment\""), 1), 1); // the nearest itself
    EXPECT_EQ(counted(behind("pass = \"decrement\""), 253), 1);     // 0 and 255 are neighbours
    EXPECT_EQ(counted(behind("pass = \"invert\", depth_fail = \"invert\""), 0), 1);
    EXPECT_EQ(counted(behind("pass = \"invert\""), 255), 1);
    EXPECT_EQ(counted(behind("pass = \"increment\""), 2), 0);
    const std::string first = "test = \"equal\", pass = \"increment\", depth_fail = \"increment\"";
    EXPECT_EQ(counted(behind(first), 1), 1);                            // the others fail
    EXPECT_EQ(counted(behind(first + ", fail = \"decrement\""), 0), 1); // one up, one down
}

} // namespace
} // namespace shadowbench
