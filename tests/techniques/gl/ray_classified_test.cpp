// A denoiser of classified tiles over one ray a pixel: what tiles whose rays agree show, what a neighbourhood is, where a
// still penumbra ends, and what its clamp forgets and keeps.
#include "base/random.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "tests/support/leaving_shadow.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

namespace shadowbench {
namespace {

/// Of all pixels that the tile of 8 × 8 pixels of (x, y) and the eight around it have in `free`; nothing where they differ.
std::optional<float> answerAround(const Image<float>& free, int x, int y) {
    const float answer = free(x, y);
    for (int v = y / 8 * 8 - 8; v < y / 8 * 8 + 16; ++v)
        for (int u = x / 8 * 8 - 8; u < x / 8 * 8 + 16; ++u)
            if (u >= 0 && v >= 0 && u < free.width() && v < free.height() && free(u, v) != answer) return std::nullopt;
    return answer;
}

TEST(RayClassified, TilesWhoseRaysAgreeAreTheirAnswerToTheBit) {
    const Scene scene = halfPlaneScene(); // whole tiles: 96²
    Stage stage(scene);
    stage.show(0);
    const Image<float> free = imageAfter(stage, "ray-traced", 5), v = imageAfter(stage, "ray-classified", 5);
    int lit = 0, shadowed = 0;
    for (int y = 0; y < v.height(); ++y)
        for (int x = 0; x < v.width(); ++x)
            if (const auto answer = answerAround(free, x, y)) {
                ASSERT_EQ(v(x, y), *answer) << x << ", " << y;
                ++(*answer > 0 ? lit : shadowed);
            }
    EXPECT_GT(lit, 300);
    EXPECT_GT(shadowed, 100);
}

/// Zeros and ones at random, and ones in the last quarter of the width.
Image<std::uint8_t> noisyMask(glm::ivec2 size) {
    Image<std::uint8_t> image(size.x, size.y);
    Random random(7);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) image(x, y) = random.uniform() < 0.5 || 4 * x > 3 * size.x ? 255 : 0;
    return image;
}

double weightAt(int distance) { return std::exp(-3.0 * distance * distance / 81); }

TEST(RayClassified, RowsOfMasksAreWeightedMeansOverSeventeenPixels) {
    const glm::ivec2 size(77, 22); // no whole tiles
    const Image<std::uint8_t> free = noisyMask(size);
    const Scene scene = halfPlaneScene(32);
    const Stage stage(scene); // its context
    gl::Texture noisy(gl::Format::R8, size), masks(gl::Format::R32UI, {10, 6}), tiles(gl::Format::R32UI, {10, 3}),
        rows(gl::Format::R32F, size);
    noisy.upload(free);
    const auto draw = [](const gl::Texture& to, gl::Program& program) {
        const gl::RenderTarget target({&to});
        target.bind();
        program.drawScreen();
    };
    const auto screen = [](const std::string& file) {
        return gl::Program::screen("modern/ray-classified/" + file + ".frag", {});
    };
    gl::Program mask = screen("masks"), tile = screen("tiles"), row = screen("rows");
    mask.set("noisy", noisy);
    draw(masks, mask);
    tile.set("masks", masks);
    draw(tiles, tile);
    row.set("tiles", tiles).set("masks", masks).set("width", size.x);
    draw(rows, row);

    const Image<float> shares = gl::RenderTarget({&rows}).readFloat(0); // row 0 at the top
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            double sum = 0, weights = 0;
            for (int i = std::max(0, x - 8); i <= std::min(size.x - 1, x + 8); ++i) {
                weights += weightAt(i - x);
                if (free(i, y) != 0) sum += weightAt(i - x);
            }
            ASSERT_NEAR(shares(x, size.y - 1 - y), sum / weights, 1e-5) << x << ", " << y;
        }
}

/// Four standard deviations of the mean over `pixels` that each have the exponential mean over frames of one ray that is
/// free every other time: of its variance, ¼, share / (2 − share) is left. The filter shares that out among neighbours.
double fourDeviations(double share, double pixels) { return 4 * std::sqrt(0.25 * share / (2 - share) / pixels); }

TEST(RayClassified, AStillPenumbraEndsAtTheShareButForItsContrast) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double raw = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-traced", 1)));
    const auto plain = slabPoints(stage, imageAfter(stage, "ray-classified:contrast=1", 60));
    EXPECT_LT(penumbraRmsError(plain), 0.2 * raw);
    const auto contrasted = slabPoints(stage, imageAfter(stage, "ray-classified", 60));
    const double reach = 0.05; // of the edge, in metres
    const auto pixels =
        std::ranges::count_if(plain, [&](const SlabPoint& point) { return std::abs(point.at.x - hardEdge) <= reach; });
    const double share = techniques::parseVariant("ray-classified").parameters.real("share");
    const double noise = fourDeviations(share, static_cast<double>(pixels));
    EXPECT_NEAR(visibilityAt(plain, hardEdge, reach), 0.5, noise);
    // An exponent of 1.2 takes ½ to 0.435, and noise times its slope there.
    EXPECT_NEAR(visibilityAt(contrasted, hardEdge, reach), std::pow(0.5, 1.2), 1.2 * std::pow(0.5, 0.2) * noise);
}

TEST(RayClassified, NoiseFallsAsFramesGoOn) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double first = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-classified:contrast=1", 1)));
    const double later = penumbraRmsError(slabPoints(stage, imageAfter(stage, "ray-classified:contrast=1", 30)));
    EXPECT_LT(later, 0.5 * first);
}

TEST(RayClassified, AShadowThatHasGoneIsForgottenWhereRaysAgree) { EXPECT_EQ(leftOfTheUmbra("ray-classified", 1.8, 1), 0); }

} // namespace
} // namespace shadowbench
