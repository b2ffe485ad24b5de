// Maps over tiles of the light's plane: tiled shadow maps at equal texels, and adaptive ones as far as pixels need.
#include "tests/support/ground_score.h"

#include "base/error.h"

#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {
namespace {

constexpr float slabTop = -0.001F;

/// Passes of a frame.
std::uint64_t passesOf(Stage& stage, const std::string& name) { return tallied(stage, name, &gl::Tally::passes); }

TEST(SmTiled, LeavesAQuarterOfAUniformMapsErrorAtEqualTexelsOverALongDepthRange) {
    const Scene scene = avenueScene(0.5);
    EXPECT_LE(mismatchOn(1, scene, "sm-tiled:map=512"), 0.25 * mismatchOn(1, scene, "sm-uniform:map=512"));
}

TEST(SmTiled, MoreTilesAreBetterThere) {
    const Scene scene = avenueScene(0.5);
    EXPECT_LE(mismatchOn(1, scene, "sm-tiled:map=512,tiles=16"), 0.7 * mismatchOn(1, scene, "sm-tiled:map=512,tiles=1"));
}

TEST(SmTiled, IsRightAwayFromEdgesForAnyNumberOfTiles) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"sm-tiled:tiles=1", "sm-tiled:tiles=5", "sm-tiled", "sm-tiled:tiles=64,discontinuity=0"})
        EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, variant), 3).mismatch, 0) << variant;
}

TEST(SmTiled, HoldsAllAroundALightInsideTheScene) {
    const Scene scene = ringScene();
    EXPECT_LT(mismatchOn(1, scene, "sm-tiled", slabTop), 0.005); // edges
    EXPECT_GT(mismatchOn(1, scene, "sm-uniform", slabTop), 0.05);
}

/// A wide ground before the camera with one caster, large (`size` = 1) or thin, whose shadow takes a small part of it.
Scene farCasterScene(double size) {
    Scene scene = groundScene(256);
    scene.camera = {{0, 3, 9}, {0, 0, -4}, {0, 1, 0}, 50, 0.5, 60};
    scene.light = {LightKind::Directional, {}, glm::normalize(glm::dvec3(0.5, -1, 0.3)), {}, {}};
    scene.objects[0] = object(box({30, 0.2, 40}), {0, -0.1, -8});
    for (int i = 0; i < 6; ++i)
        scene.objects.push_back(object(box({0.4 * size, 1.5, 0.3 * size}), {-3 + 1.1 * i, 0.75, -9 - 0.3 * i}, 20.0 * i));
    return scene;
}

TEST(SmTiled, DepthDiscontinuitiesDrawTexelsToTheShadowsEdges) {
    const Scene scene = farCasterScene(1);
    EXPECT_LE(mismatchOn(1, scene, "sm-tiled:map=256,discontinuity=1"),
              0.6 * mismatchOn(1, scene, "sm-tiled:map=256,discontinuity=0"));
}

TEST(SmTiled, TheHeuristicMisjudgesCastersThatItsFirstMapMisses) {
    // Poles of 1.6 cm under texels of 7 cm beside a kerb in front: a first map whose texels are half a metre wide misses
    // them.
    Scene scene = farCasterScene(0.04);
    scene.objects.push_back(object(box({4, 0.3, 0.4}), {0.3, 0.15, 4}, 10));
    EXPECT_GT(mismatchOn(1, scene, "sm-tiled:map=512,discontinuity=1,analysis=64"),
              1.2 * mismatchOn(1, scene, "sm-tiled:map=512,discontinuity=0"));
}

TEST(SmTiled, AFirstMapOfATexelACellServesTheChoiceAsOneOfSixteenDoes) {
    const Scene scene = farCasterScene(1);
    const double coarse = mismatchOn(1, scene, "sm-tiled:analysis=256"),
                 fine = mismatchOn(1, scene, "sm-tiled:analysis=1024");
    EXPECT_NEAR(coarse, fine, 0.25 * fine);
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(differing(rendered(stage, "sm-tiled:analysis=16"), rendered(stage, "sm-tiled")), 0U); // it is used
}

TEST(SmAdaptive, IsTheUniformMapWhereNoPageIsFinerAndAllAreNeeded) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    // Texels as of 1024², everywhere as fine. Rounding at texel borders.
    const Image<float> adaptive = rendered(stage, "sm-adaptive:page=128,levels=3,density=16");
    const Image<float> uniform = rendered(stage, "sm-uniform:map=1024");
    const metrics::Drawn drawn = stage.drawn();
    std::size_t differing = 0;
    for (std::size_t i = 0; i < adaptive.size(); ++i)
        differing += drawn.id[i] == 1 && drawn.position[i].y > slabTop && adaptive[i] != uniform[i] ? 1 : 0;
    EXPECT_LE(differing, 5U);
}

TEST(SmAdaptive, IsRightAPixelAwayFromEdges) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    // Half a texel in x and in y is at most a pixel; four neighbours at 1.5 tell edges closer than 1.06.
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-adaptive:share=1"), 1.5).mismatch, 0);
    EXPECT_EQ(scoreOnGround(scene, stage, rendered(stage, "sm-adaptive:density=8,share=1,pages=4096"), 0.2).mismatch, 0);
}

TEST(SmAdaptive, ApproachesTheExactShadowAsRefinementGrows) {
    const Scene scene = avenueScene(0.5);
    const double warped = mismatchOn(1, scene, "sm-lispsm");
    double coarser = mismatchOn(1, scene, "sm-adaptive:levels=2");
    EXPECT_GT(coarser, warped);
    for (const char* levels : {"4", "6", "8"}) {
        const double finer = mismatchOn(1, scene, "sm-adaptive:density=4,pages=4096,levels=" + std::string(levels));
        EXPECT_LT(finer, 0.6 * coarser) << levels;
        coarser = finer;
    }
    EXPECT_LT(coarser, 0.3 * warped);
}

TEST(SmAdaptive, HoldsAllAroundALightInsideTheScene) {
    EXPECT_LT(mismatchOn(1, ringScene(), "sm-adaptive", slabTop), 0.3 * mismatchOn(1, ringScene(), "sm-cube", slabTop));
}

TEST(SmAdaptive, TakesManyPassesAndNoMorePagesThanAllowed) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(passesOf(stage, "sm-adaptive"), 20 * passesOf(stage, "sm-uniform"));
    // Beside the pages: the pass over the pixels, and the test of each filling of 64 pages.
    EXPECT_LE(passesOf(stage, "sm-adaptive:pages=50,density=16,map=1024"), 50U + 2);
    EXPECT_GE(passesOf(stage, "sm-adaptive:pages=50,density=16,map=1024"), 48U + 2); // a cut adds up to three
    EXPECT_LE(passesOf(stage, "sm-adaptive:pages=200,density=16,map=1024"), 200U + 1 + 4);
}

TEST(SmAdaptive, DrawsOverASmallMapAgainAndAgainWithTheSameResult) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const Image<float> whole = rendered(stage, "sm-adaptive:map=4096");
    EXPECT_EQ(differing(rendered(stage, "sm-adaptive:map=128"), whole), 0U);
}

/// A technique and how many pages it draws.
struct Pages {
    std::unique_ptr<techniques::Technique> technique;
    explicit Pages(const std::string& name) {
        const techniques::Variant variant = techniques::parseVariant(name);
        technique = variant.entry->make(variant.parameters);
    }
    std::map<std::string, double> figuresAt(Stage& stage, int frame) const {
        stage.render(*technique, frame, 1);
        return technique->figures(stage.frame(frame, 1));
    }
};

TEST(SmAdaptive, KeepsPagesWithTheImageOfAFreshStart) {
    const Scene scene = movingAvenue();
    Stage stage(scene);
    // Room for all pages, and for some of them.
    for (const char* variant : {"sm-adaptive", "sm-adaptive:map=256", "sm-adaptive:cache=off"}) {
        const Pages kept(variant);
        for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
            stage.show(frame);
            stage.render(*kept.technique, frame, 1);
            const Image<float> image = stage.visibility();
            EXPECT_EQ(differing(rendered(stage, variant), image), 0U) << variant << " " << frame;
        }
    }
}

TEST(SmAdaptive, DrawsWhatChangesAgain) {
    const Scene scene = movingAvenue();
    Stage stage(scene);
    const Pages pages("sm-adaptive"), forgetful("sm-adaptive:cache=off");
    const auto share = [&](const Pages& technique, int frame) {
        stage.show(frame);
        const auto figures = technique.figuresAt(stage, frame);
        return figures.at("drawn") / figures.at("pages");
    };
    EXPECT_EQ(share(pages, 0), 1);
    EXPECT_EQ(share(pages, 1), 0); // nothing moves
    const double moved = share(pages, 3);
    EXPECT_GT(moved, 0); // a box has
    EXPECT_LT(moved, 0.5);
    const double seen = share(pages, 5);
    EXPECT_GT(seen, 0); // the camera has, too
    EXPECT_LT(seen, 0.8);
    pages.technique->reset();
    EXPECT_EQ(share(pages, 5), 1);
    EXPECT_EQ(share(forgetful, 5), 1);
    EXPECT_EQ(share(forgetful, 5), 1);
}

TEST(SmAdaptive, DrawsAllAgainInAnotherLight) {
    Scene scene = movingAvenue();
    scene.lightDirection.keys = {{0, scene.light.direction},
                                 {1, glm::normalize(scene.light.direction + glm::dvec3(0, 0, 0.1))}};
    scene.objects[1].motion = {};
    Stage stage(scene);
    const Pages pages("sm-adaptive");
    for (const int frame : {0, 3}) {
        stage.show(frame);
        const auto figures = pages.figuresAt(stage, frame);
        EXPECT_EQ(figures.at("drawn"), figures.at("pages")) << frame;
    }
}

TEST(SmAdaptive, APercentileOfPixelsLeavesOutPagesThatFewAskFor) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    const auto pages = [&](const std::string& share) {
        return figuresOf(stage, "sm-adaptive:pages=4096,share=" + share).at("pages");
    };
    EXPECT_LT(pages("0.95"), pages("1"));
    EXPECT_LT(pages("0.5"), pages("0.95"));
    EXPECT_EQ(pages("0"), 1); // no page is refined for anybody
}

TEST(SmAdaptive, RefusesAPageThatIsLargerThanTheMap) {
    EXPECT_THROW(techniques::parseVariant("sm-adaptive:map=64"), BadInput);
    EXPECT_NO_THROW(techniques::parseVariant("sm-adaptive:map=64,page=64"));
}

} // namespace
} // namespace shadowbench
