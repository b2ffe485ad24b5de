// Blurred PCF against its closed form, a Gaussian in the image, and the halo that it must have.
#include "base/error.h"
#include "scene/load/load.h"
#include "tests/support/filtered_scenes.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr int reach = 7; // pixels

/// Weights of pixels −7 … 7.
class Gaussian {
public:
    explicit Gaussian(double sigma) {
        double sum = 0;
        for (int i = -reach; i <= reach; ++i) sum += weights_.at(placeOf(i)) = std::exp(-0.5 * i * i / (sigma * sigma));
        for (double& weight : weights_) weight /= sum;
    }

    [[nodiscard]] double operator()(int i) const { return weights_.at(placeOf(i)); }

private:
    static std::size_t placeOf(int i) {
        const int place = i + reach;
        return static_cast<std::size_t>(place);
    }

    std::array<double, 2 * reach + 1> weights_{};
};

TEST(PcfBlur, IsPcfUnderASeparableGaussianOfFifteenTaps) {
    const Scene scene = boxScene(64);
    Stage stage(scene);
    stage.show(0);
    const Image<float> sharp = rendered(stage, "pcf:map=256"), blurred = rendered(stage, "pcf-blur:map=256,sigma=3");
    const Gaussian weights(3);
    double worst = 0, change = 0;
    for (int y = 0; y < sharp.height(); ++y)
        for (int x = 0; x < sharp.width(); ++x) {
            double sum = 0;
            for (int j = -reach; j <= reach; ++j)
                for (int i = -reach; i <= reach; ++i)
                    sum += weights(i) * weights(j) *
                           static_cast<double>(
                               sharp(std::clamp(x + i, 0, sharp.width() - 1), std::clamp(y + j, 0, sharp.height() - 1)));
            worst = std::max(worst, std::abs(sum - static_cast<double>(blurred(x, y))));
            change = std::max(change, std::abs(static_cast<double>(sharp(x, y)) - static_cast<double>(blurred(x, y))));
        }
    EXPECT_LT(worst, 1e-5);
    EXPECT_GT(change, 0.3);
}

/// The share of a Gaussian of standard deviation 1 below t.
double gaussianShare(double t) { return 0.5 * std::erfc(-t / std::sqrt(2)); }

TEST(PcfBlur, AStraightEdgeIsTheSumOfAGaussian) {
    const Scene scene = edgeScene(2); // the edge is the middle column of the image, in every row
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    for (const double sigma : {1.5, 2.5}) {
        // Texels of a quarter of a pixel and less where rows are taken: what PCF itself smooths is left out of sight, and so
        // is the map's rim at the far end of the slab.
        const Image<float> v = rendered(stage, "pcf-blur:map=4096,sigma=" + std::to_string(sigma));
        double worst = 0;
        int rows = 0;
        for (int y = reach; y + reach < v.height(); ++y) {
            const float z = drawn.position(v.width() / 2, y).z;
            if (drawn.id(v.width() / 2, y) != 1 || z < -4 || z > 2) continue;
            ++rows;
            for (int x = 0; x < v.width(); ++x)
                worst = std::max(
                    worst, std::abs(static_cast<double>(v(x, y)) - gaussianShare((0.5 * v.width() - (x + 0.5)) / sigma)));
        }
        EXPECT_GT(rows, 60);
        EXPECT_LT(worst, 0.03) << sigma;
    }
}

/// Pixels of the wall of "screen-overlap" in whose neighbourhood, as far as the taps reach, all of the wall is in shadow.
class Halo : public testing::Test {
protected:
    static constexpr unsigned wall = 2, firstPost = 4; // surfaces count from 1, in the scene's order

    Halo() : scene_((testContext(), loadScene("screen-overlap", Profile::Gate))), stage_(scene_) {
        stage_.show(0);
        sharp_ = rendered(stage_, "pcf");
        drawn_ = stage_.drawn();
    }

    template <typename Visit>
    void visitAround(int x, int y, Visit visit) const {
        for (int j = std::max(0, y - reach); j <= std::min(sharp_.height() - 1, y + reach); ++j)
            for (int i = std::max(0, x - reach); i <= std::min(sharp_.width() - 1, x + reach); ++i) visit(i, j);
    }

    [[nodiscard]] bool inDeepShadow(int x, int y) const {
        bool dark = drawn_.id(x, y) == wall;
        visitAround(x, y, [&](int i, int j) { dark = dark && (drawn_.id(i, j) != wall || sharp_(i, j) == 0); });
        return dark;
    }

    /// Whether another surface that light reaches lies within the taps' reach.
    [[nodiscard]] bool besideLight(int x, int y) const {
        bool beside = false;
        visitAround(x, y, [&](int i, int j) { beside = beside || sharp_(i, j) > 0; });
        return beside;
    }

    /// Whether a lit post lies at most 7 pixels to the left or to the right.
    [[nodiscard]] bool besideAPost(int x, int y) const {
        for (int i = std::max(0, x - reach); i <= std::min(sharp_.width() - 1, x + reach); ++i)
            if (drawn_.id(i, y) >= firstPost && sharp_(i, y) == 1) return true;
        return false;
    }

    Scene scene_;
    Stage stage_;
    Image<float> sharp_;
    metrics::Drawn drawn_;
};

TEST_F(Halo, OfLitPostsLiesOverTheShadowBehindThem) { // Fig. 3.4
    const Image<float> blurred = rendered(stage_, "pcf-blur"), inTheMap = rendered(stage_, "pcf:kernel=7");
    double halo = 0, filtered = 0;
    int beside = 0, away = 0;
    for (int y = 0; y < sharp_.height(); ++y)
        for (int x = 0; x < sharp_.width(); ++x) {
            if (!inDeepShadow(x, y)) continue;
            if (!besideLight(x, y)) {
                EXPECT_EQ(blurred(x, y), 0); // nothing comes from farther than the taps reach
                ++away;
            } else if (besideAPost(x, y)) {
                halo += blurred(x, y);
                filtered = std::max(filtered, static_cast<double>(inTheMap(x, y)));
                ++beside;
            }
        }
    ASSERT_GT(beside, 500);
    EXPECT_GT(away, 500);
    EXPECT_GT(halo / beside, 0.1);
    EXPECT_LT(filtered, 0.01); // a filter in the map is not fooled
}

TEST_F(Halo, AloneSpoilsMoreThanATenthOfTheReceivers) { // hence the scene's expectation of bad30
    const Image<float> blurred = rendered(stage_, "pcf-blur");
    const Gaussian weights(2.5);
    int spoilt = 0, receivers = 0;
    for (int y = 0; y < sharp_.height(); ++y)
        for (int x = 0; x < sharp_.width(); ++x) {
            if (drawn_.id(x, y) == 0) continue;
            // The same Gaussian, over the pixel's own surface alone.
            double sum = 0, weight = 0;
            visitAround(x, y, [&](int i, int j) {
                if (drawn_.id(i, j) != drawn_.id(x, y)) return;
                const double share = weights(i - x) * weights(j - y);
                sum += share * static_cast<double>(sharp_(i, j));
                weight += share;
            });
            ++receivers;
            spoilt += std::abs(static_cast<double>(blurred(x, y)) - sum / weight) > 30.0 / 255 ? 1 : 0;
        }
    EXPECT_GT(spoilt, 0.1 * receivers);
}

TEST_F(Halo, OfTheShadowLiesOverTheLitPosts) { // and the other way round
    const Image<float> blurred = rendered(stage_, "pcf-blur");
    double darkened = 0;
    int count = 0;
    for (int y = 0; y < sharp_.height(); ++y)
        for (int x = 1; x < sharp_.width(); ++x) {
            if (drawn_.id(x, y) < firstPost || sharp_(x, y) != 1 || !inDeepShadow(x - 1, y)) continue;
            darkened += 1 - static_cast<double>(blurred(x, y));
            ++count;
        }
    ASSERT_GT(count, 100);
    EXPECT_GT(darkened / count, 0.3); // nearly half of the Gaussian at the first pixel lies over the wall
}

TEST(PcfBlur, PenumbraIsAsManyPixelsWideWhereverTheOccluderIs) { // what the source admits
    for (const double height : {1.2, 5.0}) {
        const Scene scene = edgeScene(height);
        Stage stage(scene);
        stage.show(0);
        const Image<float> v = rendered(stage, "pcf-blur:map=2048");
        int grey = 0;
        const int y = v.height() - 40;
        for (int x = 0; x < v.width(); ++x) grey += v(x, y) > 0.16F && v(x, y) < 0.84F ? 1 : 0; // a deviation to either side
        EXPECT_NEAR(grey, 5, 1) << height;
    }
}

TEST(PcfBlur, RefusesAGaussianThatItsTapsDoNotHold) {
    EXPECT_THROW(techniques::parseVariant("pcf-blur:sigma=9"), BadInput);
    EXPECT_THROW(techniques::parseVariant("pcf-blur:sigma=0"), BadInput);
}

} // namespace
} // namespace shadowbench
