// Jittered PCF against its closed form: the mean of its noise is the ramp of a disk.
#include "base/error.h"
#include "techniques/shared/filters/jitter_table.h"
#include "tests/support/bands.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr int map = 128; // texels of 9 cm of ground, of which a pixel sees about one: bands show

double linearRamp(double t) { return 0.5 + 0.5 * t; }

/// Of the edge's penumbra, `reach` texels to either side of it; bins of a sixth of a texel.
BandsAndNoise measured(const Scene& scene, Stage& stage, const std::string& variant, double reach, double (*ramp)(double)) {
    const auto points = groundPoints(stage, rendered(stage, variant + ",map=" + std::to_string(map)));
    return bandsAndNoise(points, mapEdge(stage, map), reach * texelOf(scene, map), ramp,
                         static_cast<int>(std::lround(12 * reach)));
}

TEST(PcfJitter, TheMeanIsTheDisksRampAndTheRestIsNoise) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const BandsAndNoise left = measured(scene, stage, "pcf-jitter:radius=6", 6, diskShare);
    EXPECT_LT(left.worstMean, 0.01);
    // An edge meets about 16 of 64 cells; a tap in one of these is lit or not, by its share of it: √(16/6)/64 and no more.
    // 64 taps anywhere in the disk would leave twice as much.
    EXPECT_LT(left.noise, 0.03);
    EXPECT_GT(left.noise, 0.01);
}

TEST(PcfJitter, FewerTapsLeaveMoreNoiseOverTheSameRamp) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const BandsAndNoise few = measured(scene, stage, "pcf-jitter:radius=6,taps=16", 6, diskShare);
    const BandsAndNoise many = measured(scene, stage, "pcf-jitter:radius=6", 6, diskShare);
    EXPECT_LT(few.worstMean, 0.03);
    EXPECT_GT(few.noise, 2 * many.noise); // cells that the edge meets: half as many, of four times the weight
}

TEST(PcfJitter, TradesTheBandsOfPcfForNoise) { // with as many taps over as wide a penumbra
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const BandsAndNoise regular = measured(scene, stage, "pcf:kernel=7", 3.5, linearRamp);
    const BandsAndNoise jittered = measured(scene, stage, "pcf-jitter:taps=48", 3.5, diskShare);
    // 49 taps of which seven each see the same texels' column: steps of a seventh, and between the steps nothing.
    EXPECT_NEAR(regular.bands, 1.0 / 7 / std::sqrt(12), 0.01);
    EXPECT_LT(regular.noise, 0.3 * regular.bands);
    EXPECT_LT(jittered.bands, 0.1 * regular.bands);
    EXPECT_GT(jittered.noise, 5 * jittered.bands);
}

TEST(PcfJitter, PenumbraIsTheSameWidthWhereverTheOccluderIs) { // what the source admits
    double nearest = 0;
    for (const double height : {1.2, 2.5, 5.0}) {
        const Scene scene = edgeScene(height);
        Stage stage(scene);
        stage.show(0);
        const double width = greyWidth(groundPoints(stage, rendered(stage, "pcf-jitter:map=128,radius=6")));
        if (nearest == 0) nearest = width;
        EXPECT_NEAR(width, nearest, 0.1 * nearest) << height;
    }
    EXPECT_NEAR(nearest, 2 * 6 * texelOf(edgeScene(2), map), 0.15 * nearest); // the rim's last cells are met rarely
}

TEST(PcfJitter, TakesTheOtherTapsOnlyWhereTheOutermostRingIsUndecided) {
    // A plate of 8 × 8 texels under a disk of 16 texels' radius: from its middle the outermost ring, 15 texels away, sees
    // light all around, and so the plate, an eighth of the disk's other taps, has no shadow at all.
    Scene scene = edgeScene(2);
    const double texel = texelOf(scene, 256);
    scene.objects[1] = object(box({8 * texel, 0.1, 8 * texel}), {edgeAt, 2.05, 0});
    Stage stage(scene);
    stage.show(0);
    const auto around = [&](const std::string& variant) {
        double sum = 0, count = 0;
        for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant)))
            if (std::hypot(point.at.x - edgeAt, point.at.z) < 4 * texel) {
                sum += point.visibility;
                ++count;
            }
        EXPECT_GT(count, 50);
        return sum / count;
    };
    EXPECT_EQ(around("pcf-jitter:map=256,radius=16"), 1);
    EXPECT_NEAR(around("pcf-poisson:map=256,radius=16,taps=64"), 1 - 64 / (3.14159 * 16 * 16), 0.03);
}

/// What shaders read of the table for `pair` in an image of 40 × 40 pixels.
Image<glm::vec4> pairsRead(const techniques::JitterTable& table, int pair, std::uint32_t seed) {
    const gl::Texture taps(gl::Format::RGBA32F, {40, 40});
    const gl::RenderTarget target({&taps});
    gl::Program program = gl::Program::screenFromText("pairs of taps",
                                                      "#include \"shared/filters/jitter_table.glsl\"\n"
                                                      "uniform sampler2D table;\n"
                                                      "uniform int pair;\n"
                                                      "out vec4 taps;\n"
                                                      "void main() { taps = jitteredPair(table, pair); }\n",
                                                      techniques::JitterTable::defines());
    program.set("table", table.texture()).set("pair", pair).set("jitterOrigin", techniques::JitterTable::origin(seed));
    target.bind();
    program.drawScreen();
    return target.readVec4(0);
}

TEST(PcfJitter, EveryPixelOfABlockHasASetOfItsOwn) {
    testContext();
    using namespace techniques;
    const JitterGrid grid{8, 8};
    const JitterTable table(grid);
    for (const std::uint32_t seed : {1U, 2U, 3U})
        for (const int pair : {0, 5, 31}) {
            const Image<glm::vec4> read = pairsRead(table, pair, seed);
            const glm::ivec2 origin(JitterTable::origin(seed));
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 40; ++x) {
                    const int set = (x + origin.x) % jitterBlock + jitterBlock * ((y + origin.y) % jitterBlock);
                    const auto taps = jitteredTaps(grid, static_cast<std::uint32_t>(set));
                    const std::size_t first = 2 * static_cast<std::size_t>(pair);
                    ASSERT_EQ(read(x, 39 - y), glm::vec4(taps[first], taps[first + 1])); // GL's rows are upwards
                }
        }
}

TEST(PcfJitter, ASeedIsAnImage) {
    const Scene scene = edgeScene(2, 96);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "pcf-jitter:map=256", 1, 3), rendered(stage, "pcf-jitter:map=256", 1, 3));
    EXPECT_NE(rendered(stage, "pcf-jitter:map=256", 1, 3), rendered(stage, "pcf-jitter:map=256", 1, 4));
}

TEST(PcfJitter, RefusesTapsThatFillNoRings) {
    EXPECT_THROW(techniques::parseVariant("pcf-jitter:taps=20"), BadInput);
    EXPECT_THROW(techniques::parseVariant("pcf-jitter:radius=0"), BadInput);
}

} // namespace
} // namespace shadowbench
