// A clipmap of cached pages: which pages a view asks for, which of them are drawn again, and what too few slots do.
#include "techniques/modern/sm-clipmap/clipmap.h"

#include "base/error.h"
#include "techniques/modern/sm-clipmap/page_budget.h"
#include "tests/support/ground_score.h"
#include "tests/support/rows_over_frames.h"
#include "tests/support/shader_function.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

constexpr float slabTop = -0.001F;
constexpr double halfSeen = 3; // of the ground's square that the camera sees, in metres
constexpr double pageSide = 2; // 128 texels of 1/64 m: a pixel is 6/256 m wide
constexpr double eyeZ = 0.3;

/// A ground and a few boxes under the sun in the zenith, seen from straight above.
Scene zenithScene(double groundSide) {
    Scene scene = groundScene(256);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.objects[0] = object(box({groundSide, 0.2, groundSide}), {0, -0.1, 0});
    scene.objects.push_back(object(box({0.5, 0.5, 0.5}), {-1.2, 0.4, 0.8}));
    scene.objects.push_back(object(box({1.3, 0.1, 0.7}), {1.13, 0.9, -0.87}, 23));
    scene.camera = {{0.5, 5, eyeZ}, {0.5, 0, eyeZ}, {0, 0, -1}, glm::degrees(2 * std::atan(halfSeen / 5)), 0.5, 20};
    return scene;
}

/// The same from above (x, 0, 0.3).
Snapshot fromAbove(const Scene& scene, double x) {
    Snapshot seen = snapshot(scene, 0);
    seen.camera.eye.x = seen.camera.target.x = x;
    return seen;
}

/// Pages along an axis of the light's plane between the outermost pixels of the square around `middle`.
int pagesAcross(double middle) {
    const double half = halfSeen * (1 - 1.0 / 256);
    return static_cast<int>(std::floor((middle + half) / pageSide) - std::floor((middle - half) / pageSide)) + 1;
}

/// A row's figures after it has drawn what the stage shows.
std::map<std::string, double> figuresAfter(Stage& stage, techniques::Technique& row) {
    stage.render(row, 0, 1);
    return row.figures(stage.frame(0, 1));
}

TEST(SmClipmap, AsksForThePagesOfTheSquareThatIsSeen) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    for (const double x : {0.5, 1.4, -2.9, 7.07}) {
        stage.show(fromAbove(scene, x));
        const auto figures = figuresOf(stage, "sm-clipmap");
        EXPECT_EQ(figures.at("asked"), pagesAcross(-x) * pagesAcross(eyeZ)) << x;
        EXPECT_EQ(figures.at("pages"), figures.at("asked"));
        EXPECT_EQ(figures.at("coarser"), 0);
    }
}

TEST(SmClipmap, DrawsNothingAgainWhileNothingMoves) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    stage.show(0);
    const auto row = rowOf("sm-clipmap"), forgetful = rowOf("sm-clipmap:cache=off");
    const double pages = figuresAfter(stage, *row).at("pages");
    EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), 0);
    row->reset();
    EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), pages);
    figuresAfter(stage, *forgetful);
    EXPECT_EQ(figuresAfter(stage, *forgetful).at("drawn"), pages);
}

TEST(SmClipmap, APanByAPageDrawsOneColumn) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    const auto row = rowOf("sm-clipmap");
    stage.show(fromAbove(scene, 0.5));
    figuresAfter(stage, *row);
    for (int step = 1; step <= 3; ++step) {
        stage.show(fromAbove(scene, 0.5 + pageSide * step));
        EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), pagesAcross(eyeZ)) << step;
    }
    stage.show(fromAbove(scene, 0.5));
    EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), 0); // the pool still holds them
}

TEST(SmClipmap, APoolOfNoMorePagesThanAreSeenDrawsAllAgainThatComesBack) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    ASSERT_EQ(pagesAcross(-0.5) * pagesAcross(eyeZ), 16);
    const auto row = rowOf("sm-clipmap:map=512"); // 16 pages
    stage.show(fromAbove(scene, 0.5));
    figuresAfter(stage, *row);
    for (const double x : {2.5, 0.5, 2.5}) {
        stage.show(fromAbove(scene, x));
        EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), pagesAcross(eyeZ)) << x;
    }
}

TEST(SmClipmap, DrawsAllAgainUnderAnotherLight) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    const auto row = rowOf("sm-clipmap");
    stage.show(0);
    figuresAfter(stage, *row);
    Snapshot turned = snapshot(scene, 0);
    turned.light.direction = glm::normalize(glm::dvec3(0.01, -1, 0));
    stage.show(turned);
    const auto figures = figuresAfter(stage, *row);
    EXPECT_EQ(figures.at("drawn"), figures.at("pages"));
}

TEST(SmClipmap, DrawsThePageAgainInWhichACasterMoves) {
    const Scene scene = zenithScene(40);
    Stage stage(scene);
    const auto row = rowOf("sm-clipmap");
    stage.show(0);
    figuresAfter(stage, *row);
    Snapshot moved = snapshot(scene, 0);
    glm::dmat4& world = moved.batches.at(1).placements.at(0).world;
    world = glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0, 0.1)) * world; // from x = −1.2 to −0.9: columns end at −2 and 0
    stage.show(moved);
    EXPECT_EQ(figuresAfter(stage, *row).at("drawn"), 1);
}

TEST(SmClipmap, KeepsPagesWithTheImageOfAFreshStart) {
    const Scene scene = movingAvenue();
    Stage stage(scene);
    // Room for all pages, and for some of them.
    for (const char* variant : {"sm-clipmap", "sm-clipmap:map=512", "sm-clipmap:cache=off"}) {
        const auto kept = rowOf(variant);
        for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
            stage.show(frame);
            stage.render(*kept, frame, 1);
            const Image<float> image = stage.visibility();
            EXPECT_EQ(differing(rendered(stage, variant), image), 0U) << variant << " " << frame;
        }
    }
}

TEST(SmClipmap, IsAUniformMapWhereOneLevelHoldsAllAndItsTexelsAreThose) {
    const Scene scene =
        zenithScene(16); // a map of 1024² over the ground: texels of 1/64 m, as of the level that is asked for
    Stage stage(scene);
    stage.show(0);
    const Image<float> uniform = rendered(stage, "sm-uniform:map=1024");
    EXPECT_GT(std::ranges::count(uniform, 0.0F), 300);
    EXPECT_LE(differing(rendered(stage, "sm-clipmap"), uniform), 5U); // rounding at borders of texels
    EXPECT_LE(differing(rendered(stage, "sm-clipmap:levels=1"), uniform), 5U);
}

TEST(SmClipmap, HasTheTexelsOfAUniformMapUnderALamp) {
    const Scene scene = boxScene(256);
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const auto others = [&](const std::string& a, const std::string& b) { // on the ground, but for rounding
        const Image<float> one = rendered(stage, a), two = rendered(stage, b);
        std::size_t count = 0;
        for (std::size_t i = 0; i < one.size(); ++i)
            count += drawn.id[i] == 1 && drawn.position[i].y > slabTop && one[i] != two[i] ? 1 : 0;
        return count;
    };
    EXPECT_LE(others("sm-clipmap:extent=1024,density=16", "sm-uniform:map=1024"), 5U); // everywhere the finest level
    EXPECT_LE(others("sm-clipmap:map=128", "sm-uniform:map=128"), 5U); // a pool of one page: that of the whole plane
    EXPECT_LE(others("sm-clipmap:levels=1", "sm-uniform:map=128"), 5U);
}

// Texels are as short as pixels across the light's rays, and longer where these graze the ground.
TEST(SmClipmap, HoldsAllAroundALightInsideTheScene) {
    const double cube = mismatchOn(1, ringScene(), "sm-cube", slabTop);
    EXPECT_LT(mismatchOn(1, ringScene(), "sm-clipmap:density=8", slabTop), cube);
    EXPECT_LT(mismatchOn(1, ringScene(), "sm-clipmap", slabTop), 3 * cube);
}

TEST(SmClipmap, TooFewPagesFallBackToCoarserLevels) {
    const Scene scene = avenueScene(0.5);
    Stage stage(scene);
    stage.show(0);
    double error = mismatchOn(1, scene, "sm-clipmap"), coarser = 0;
    EXPECT_EQ(figuresOf(stage, "sm-clipmap").at("coarser"), 0);
    for (const int map : {768, 512, 256}) {
        const std::string variant = "sm-clipmap:map=" + std::to_string(map);
        const auto figures = figuresOf(stage, variant);
        EXPECT_LE(figures.at("pages"), map / 128 * (map / 128));
        EXPECT_GT(figures.at("coarser"), coarser) << map;
        const double now = mismatchOn(1, scene, variant);
        EXPECT_GT(now, error) << map;
        error = now;
        coarser = figures.at("coarser");
    }
    EXPECT_LT(error, mismatchOn(1, scene, "none")); // all that is left are coarse shadows
}

TEST(SmClipmap, LeavesAFractionOfTheErrorOfStableCascadesInAsManyTexels) { // without a filter over either
    const Scene scene = avenueScene(0.1);
    EXPECT_LT(mismatchOn(1, scene, "sm-clipmap:map=1024"),
              0.5 * mismatchOn(1, scene, "sm-cascaded:fit=view,lambda=0.5,stable=texels"));
}

using namespace techniques;

/// The avenue's sun and a camera that has moved.
Clipmap clipmapAt(const Scene& scene, const glm::dvec3& eye, const ClipmapRule& rule = {}) {
    Snapshot seen = snapshot(scene, 0);
    seen.camera.eye += eye;
    seen.camera.target += eye;
    return {rule, scene.light, seen, scene.size};
}

TEST(Clipmap, AWindowHoldsTheCoarserPagesOfAFinerOne) {
    const Scene scene = avenueScene(0.5);
    for (double moved = 0; moved < 40; moved += 0.37) {
        const Clipmap clipmap = clipmapAt(scene, {moved, 0, -1.7 * moved}, {.texels = 16, .extent = 64, .levels = 8});
        for (std::size_t window = 0; window + 1 < clipmap.windows().size(); ++window) {
            const PageWindow& pages = clipmap.windows()[window];
            for (int corner = 0; corner < 4; ++corner) {
                const glm::ivec2 at = pages.first + (pages.pages - 1) * glm::ivec2(corner & 1, corner >> 1);
                EXPECT_TRUE(clipmap.entryOf(0, window, at));
                EXPECT_TRUE(clipmap.entryOf(0, window + 1, coarserPage({0, pages.level, at}).at)) << moved << " " << window;
            }
        }
    }
}

TEST(Clipmap, EntriesAndPagesAreOfEachOther) {
    for (const Scene& scene : {avenueScene(0.5), ringScene()}) {
        const Clipmap clipmap = clipmapAt(scene, {});
        std::size_t found = 0;
        for (std::size_t entry = 0; entry < clipmap.entries(); ++entry) {
            const Page page = clipmap.pageOf(entry);
            const auto window = static_cast<std::size_t>(page.level - clipmap.windows().front().level);
            if (const auto back = clipmap.entryOf(page.plane, window, page.at)) {
                EXPECT_EQ(*back, entry);
                ++found;
            }
        }
        std::size_t pages = 0;
        for (const PageWindow& window : clipmap.windows())
            pages += clipmap.planes().size() * static_cast<std::size_t>(window.pages * window.pages);
        EXPECT_EQ(found, pages);
    }
}

TEST(Clipmap, PlacesPointsAsTheShaderDoes) {
    for (const Scene& scene : {avenueScene(0.5), ringScene()}) {
        const Clipmap clipmap = clipmapAt(scene, {0.7, 0, -0.3});
        std::vector<glm::vec4> points;
        for (float x = -5.03F; x < 5; x += 0.71F)
            for (float z = -4.9F; z < -1; z += 0.37F) points.emplace_back(x, 0.01F - 0.1F * z, z, 1);
        const auto placed = evaluated(
            "modern/sm-clipmap/pages.glsl",
            "placeOf(x.xyz).at.xy, float(placeOf(x.xyz).level), float(entryOf(placeOf(x.xyz), placeOf(x.xyz).level))",
            points, {{"LEVELS", "16"}}, [&](gl::Program& program) { clipmap.bindTo(program); });
        std::size_t same = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const PointInPages place = clipmap.placeOf(glm::dvec3(points[i]));
            const glm::dvec2 finest = clipmap.inWindow(place, 0);
            EXPECT_NEAR(placed[i].x, finest.x, 1e-5 * (1 + std::abs(finest.x)));
            EXPECT_NEAR(placed[i].y, finest.y, 1e-5 * (1 + std::abs(finest.y)));
            const glm::ivec2 at(glm::floor(clipmap.inWindow(place, place.window)));
            const auto entry = clipmap.entryOf(place.plane, place.window, at);
            ASSERT_TRUE(entry) << i;
            same += placed[i].z == static_cast<float>(place.window) && placed[i].w == static_cast<float>(*entry) ? 1 : 0;
        }
        EXPECT_GE(same, points.size() - points.size() / 50); // rounding where a page or a level ends
    }
}

TEST(SmClipmap, RefusesPagesThatDoNotFit) {
    EXPECT_THROW(parseVariant("sm-clipmap:map=64"), BadInput);
    EXPECT_THROW(parseVariant("sm-clipmap:extent=256"), BadInput);  // two pages
    EXPECT_THROW(parseVariant("sm-clipmap:extent=1536"), BadInput); // twelve
    EXPECT_NO_THROW(parseVariant("sm-clipmap:extent=16384"));
    EXPECT_NO_THROW(parseVariant("sm-clipmap:map=64,page=64"));
}

} // namespace
} // namespace shadowbench
