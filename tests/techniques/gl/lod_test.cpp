// Level-of-detail techniques on scenes whose pictures have a closed form.
#include "scene/load/load.h"
#include "tests/support/lod_scenes.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>

namespace shadowbench {
namespace {

int difference(glm::u8vec3 a, glm::u8vec3 b) {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel) largest = std::max(largest, std::abs(a[channel] - b[channel]));
    return largest;
}

/// The halves of two 8-bit colours; rounding is off by half a step.
glm::u8vec3 mean(glm::u8vec3 a, glm::u8vec3 b) { return glm::u8vec3((glm::uvec3(a) + glm::uvec3(b)) / 2U); }

/// One object of the scene alone at one of its levels: its colour, or nothing.
class Silhouette {
public:
    Silhouette(const Scene& scene, std::size_t object, std::size_t level) : picture_(alone(scene, object, level)) {
        Scene empty = scene;
        empty.objects.clear();
        nothing_ = walked(empty, "lod-full", 1).back();
    }
    [[nodiscard]] bool covers(std::size_t pixel) const { return picture_[pixel] != nothing_[pixel]; }
    [[nodiscard]] glm::u8vec3 colour(std::size_t pixel) const { return picture_[pixel]; }

private:
    static ColourImage alone(const Scene& scene, std::size_t object, std::size_t level) {
        Scene one = scene;
        one.objects = {scene.objects[object]};
        return levelPicture(one, level, 0);
    }
    ColourImage picture_, nothing_;
};

/// How many pixels each case of the combination was met by (dissertation 5.1.4).
struct Cases {
    int neither = 0, sameInstance = 0, oneOrOther = 0;
};

TEST(FrameSequential, HalfWayEachPixelIsTheMeanOfBothLevelsWhereTheyOverlapElseTheNearest) {
    const Scene scene = crossesScene(0.5);
    const Silhouette wall(scene, 0, 0), farFine(scene, 1, 0), farCoarse(scene, 1, 1), nearFine(scene, 2, 0),
        nearCoarse(scene, 2, 1);
    const auto pictures = walked(scene, "lod-frame-sequential", 4);
    Cases cases;
    for (const ColourImage& picture : pictures) {
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const Silhouette* fine = nearFine.covers(i) || nearCoarse.covers(i) ? &nearFine : &farFine;
            const Silhouette* coarse = fine == &nearFine ? &nearCoarse : &farCoarse;
            glm::u8vec3 expected = wall.colour(i);
            if (fine->covers(i) && coarse->covers(i)) {
                expected = mean(fine->colour(i), coarse->colour(i));
                ++cases.sameInstance;
            } else if (fine->covers(i) || coarse->covers(i)) {
                expected = (fine->covers(i) ? fine : coarse)->colour(i);
                ++cases.oneOrOther;
            } else {
                ++cases.neither;
            }
            ASSERT_LE(difference(picture[i], expected), 1) << "pixel " << i; // rounding
        }
    }
    EXPECT_GT(cases.neither, 4 * 2000);
    EXPECT_GT(cases.sameInstance, 4 * 200);
    EXPECT_GT(cases.oneOrOther, 4 * 500);
}

TEST(FrameSequential, BeforeTheMiddleTheFinerLevelIsWholeAndTheCoarserStippled) {
    const Scene scene = crossesScene(0.25);
    const Silhouette fine(scene, 2, 0), coarse(scene, 2, 1), far(scene, 1, 0), farCoarse(scene, 1, 1);
    const ColourImage picture = walked(scene, "lod-frame-sequential", 2).back();
    int seen = 0, all = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (fine.covers(i) && !coarse.covers(i)) {
            ASSERT_EQ(difference(picture[i], fine.colour(i)), 0); // no hole anywhere
        }
        if (!coarse.covers(i) || fine.covers(i) || far.covers(i) || farCoarse.covers(i)) continue;
        ++all;
        if (picture[i] == coarse.colour(i)) ++seen;
    }
    // Half of the fragments, independently: four standard deviations of a binomial count.
    EXPECT_NEAR(seen, 0.5 * all, 4 * std::sqrt(0.25 * all));
    EXPECT_GT(all, 200);
}

TEST(FrameSequential, WithNothingInTransitionItIsDiscreteSwitchingBitForBit) {
    testContext();
    for (const std::string id : {"simple", "windmills", "trees"}) {
        Scene scene = loadScene(id, Profile::Gate);
        scene.size = {128, 96};
        scene.lod->band = 1e-9; // levels still change
        for (const std::string variant : {"lod-frame-sequential", "lod-frame-sequential:reproject=motion", "lod-blend"})
            EXPECT_EQ(walked(scene, variant, 24), walked(scene, "lod-switch", 24)) << variant << " on " << id;
    }
}

/// A bar that turns into a slightly shorter and wider one, half-way for ever, in front of a wall.
Scene barScene() {
    Scene scene = wallScene(160);
    scene.objects.push_back(
        inTransition(scene.camera, 0.2, 0.5, {0, 0, 0}, box({0.4, 2, 0.3}), red, box({0.5, 1.8, 0.2}), blue));
    return scene;
}

/// Mean difference of a walk's pictures from what each frame should show half-way: the mean of both levels where they
/// overlap, else the one that there is. Over the pixels of the bar, in 1/255.
double errorHalfWay(const Scene& scene, const std::string& variant, int frames) {
    Scene wallOnly = scene;
    wallOnly.objects.pop_back();
    const auto pictures = walked(scene, variant, frames), wall = walked(wallOnly, "lod-full", frames);
    const auto fine = walked(atLevel(scene, 0), "lod-full", frames), coarse = walked(atLevel(scene, 1), "lod-full", frames);
    double sum = 0;
    int pixels = 0;
    for (std::size_t f = 1; f < pictures.size(); ++f) {
        for (std::size_t i = 0; i < wall[f].size(); ++i) {
            const bool isFine = fine[f][i] != wall[f][i], isCoarse = coarse[f][i] != wall[f][i];
            if (!isFine && !isCoarse) continue;
            const glm::u8vec3 expected =
                isFine && isCoarse ? mean(fine[f][i], coarse[f][i]) : (isFine ? fine : coarse)[f][i];
            sum += difference(pictures[f][i], expected);
            ++pixels;
        }
    }
    return sum / pixels;
}

TEST(FrameSequential, BackProjectionMakesUpForCameraMotion) {
    Scene scene = barScene(); // the camera pans, so that the bar's distance stays the same
    for (int frame = 0; frame < 8; ++frame)
        scene.lod->target.keys.push_back({static_cast<double>(frame), {0.15 * (frame - 4), 0.017, 0}});
    const double with = errorHalfWay(scene, "lod-frame-sequential", 8);
    const double without = errorHalfWay(scene, "lod-frame-sequential:reproject=off", 8);
    EXPECT_GT(without, 3 * with) << with;
}

TEST(FrameSequential, BackProjectionOfInstancesMakesUpForTheirMotion) {
    Scene scene = barScene(); // turns about the line of sight
    scene.objects[1].motion.degreesPerFrame = 6;
    scene.objects[1].motion.axis = {0, 0, 1};
    const double camera = errorHalfWay(scene, "lod-frame-sequential", 8);
    const double motion = errorHalfWay(scene, "lod-frame-sequential:reproject=motion", 8);
    EXPECT_GT(camera, 1.5 * motion) << motion;
}

TEST(FrameSequential, CoplanarLevelsDoNotFightForDepth) {
    // The same plate cut into triangles in two ways, seen slantwise: depths agree but for rounding.
    Scene scene = wallScene();
    scene.camera.eye = {2.3, 1.7, 5.1};
    Mesh fan = box({2, 2, 0.5});
    const auto middle = static_cast<unsigned>(fan.positions.size());
    fan.positions.emplace_back(0.137F, 0.211F, 0.25F);
    std::vector<glm::uvec3> triangles;
    for (const glm::uvec3& t : fan.triangles) {
        const bool front = fan.positions[t.x].z > 0 && fan.positions[t.y].z > 0 && fan.positions[t.z].z > 0;
        if (!front) triangles.push_back(t);
    }
    const auto corner = [&](float x, float y) {
        for (unsigned i = 0; i < middle; ++i)
            if (fan.positions[i] == glm::vec3(x, y, 0.25F)) return i;
        return 0U;
    };
    const std::array<unsigned, 4> ring{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
    for (std::size_t i = 0; i < 4; ++i) triangles.emplace_back(ring[i], ring[(i + 1) % 4], middle);
    fan.triangles = triangles;
    scene.objects.push_back(inTransition(scene.camera, 0.2, 0.5, {0, 0, 0}, box({2, 2, 0.5}), red, fan, blue));

    const Silhouette fine(scene, 1, 0), coarse(scene, 1, 1);
    const auto mixed = [&](const std::string& variant) {
        const ColourImage picture = walked(scene, variant, 4).back();
        int wrong = 0;
        for (std::size_t i = 0; i < picture.size(); ++i)
            if (fine.covers(i) && coarse.covers(i) && difference(picture[i], mean(fine.colour(i), coarse.colour(i))) > 1)
                ++wrong;
        return wrong;
    };
    EXPECT_EQ(mixed("lod-frame-sequential"), 0);
}

/// A rectangle in the plane z, facing +z.
Mesh rectangle(float halfWidth, float halfHeight, float z) {
    return {
        {{-halfWidth, -halfHeight, z}, {halfWidth, -halfHeight, z}, {halfWidth, halfHeight, z}, {-halfWidth, halfHeight, z}},
        {{0, 1, 2}, {0, 2, 3}},
        false};
}

TEST(LodBlend, FadesTheNewLevelInOverTheOldOneThenTheOldOneOut) {
    for (const double progress : {0.125, 0.375, 0.5, 0.75}) {
        Scene scene = wallScene();
        scene.objects.push_back(inTransition(scene.camera, 0.2, progress, {0, 0, 0}, rectangle(0.4F, 1.2F, 0), red,
                                             rectangle(1.2F, 0.4F, 0.1F), blue)); // the coarser one lies in front
        const Silhouette wall(scene, 0, 0), fine(scene, 1, 0), coarse(scene, 1, 1);
        const bool second = progress >= 0.5;
        const double opacity = second ? 2 - 2 * progress : 2 * progress;
        const auto over = [opacity](glm::u8vec3 front, glm::u8vec3 back) {
            return glm::u8vec3(opacity * glm::dvec3(front) + (1 - opacity) * glm::dvec3(back) + 0.5);
        };
        const ColourImage picture = walked(scene, "lod-blend", 1).back();
        int both = 0;
        for (std::size_t i = 0; i < picture.size(); ++i) {
            glm::u8vec3 expected = wall.colour(i);
            if (fine.covers(i)) expected = second ? over(fine.colour(i), expected) : fine.colour(i);
            if (coarse.covers(i)) expected = second ? coarse.colour(i) : over(coarse.colour(i), expected);
            ASSERT_LE(difference(picture[i], expected), 1) << "pixel " << i << " at " << progress; // rounding
            if (fine.covers(i) && coarse.covers(i)) ++both;
        }
        EXPECT_GT(both, 100);
    }
}

TEST(LodBlend, DependsOnTheOrderOfDrawingAndOthersDoNot) {
    testContext();
    const Scene scene = [] {
        Scene result = loadScene("trees", Profile::Gate);
        result.size = {128, 128};
        return result;
    }();
    const Scene reversed = lod::withTrianglesReversed(scene);
    const auto differing = [&](const std::string& variant) {
        const auto one = walked(scene, variant, 8), other = walked(reversed, variant, 8);
        int pixels = 0;
        for (std::size_t frame = 0; frame < one.size(); ++frame)
            for (std::size_t i = 0; i < one[frame].size(); ++i) pixels += one[frame][i] != other[frame][i] ? 1 : 0;
        return pixels / (8.0 * 128 * 128);
    };
    // A leaf's two sides meet at its rim, where their depths are equal to the last bit now and then.
    for (const std::string variant : {"lod-full", "lod-switch", "lod-frame-sequential"})
        EXPECT_LT(differing(variant), 0.0005) << variant;
    EXPECT_GT(differing("lod-blend"), 0.005);
}

TEST(LodTechniques, ForgetTheirHistoryAndRepeatThemselves) {
    testContext();
    Scene scene = loadScene("windmills", Profile::Gate);
    scene.size = {96, 96};
    for (const techniques::Variant& variant : techniques::matchVariants("lod-*")) {
        lod::LodStage stage(scene, scene.size);
        const auto technique = variant.entry->makeLod(variant.parameters);
        std::vector<ColourImage> twice[2];
        for (auto& pictures : twice) {
            technique->reset();
            for (int frame = 0; frame < 6; ++frame) {
                stage.show(frame);
                stage.render(*technique);
                pictures.push_back(stage.picture());
            }
        }
        EXPECT_EQ(twice[0], twice[1]) << variant.name;
        EXPECT_EQ(twice[0], walked(scene, variant.name, 6)) << variant.name;
    }
}

} // namespace
} // namespace shadowbench
