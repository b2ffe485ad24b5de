// The fast form of the visible fraction against its exact certifier and against shadow rays.
#include "base/parallel.h"
#include "tests/support/area_scenes.h"

#include <array>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::testing {

using namespace area;
using namespace hard;
namespace {

constexpr std::array kinds{LightKind::Rectangle, LightKind::Rectangle, LightKind::Line, LightKind::Rectangle,
                           LightKind::Disk};
constexpr int kindCount = static_cast<int>(kinds.size());

class RandomAreaScene : public ::testing::TestWithParam<int> {
protected:
    std::mt19937 random_{static_cast<unsigned>(GetParam())};
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    glm::dvec3 inBox(const glm::dvec3& low, const glm::dvec3& high) {
        return {uniform(low.x, high.x), uniform(low.y, high.y), uniform(low.z, high.z)};
    }
    glm::dmat4 somewhere() {
        return glm::rotate(at(uniform(-1.5, 1.5), uniform(0, 2.5), uniform(-1.5, 1.5)), uniform(0, 6),
                           glm::normalize(inBox(glm::dvec3(-1), glm::dvec3(1))));
    }

    /// Boxes that stand in the ground or float, soups that reach through the ground and the light's plane, bumpy meshes.
    Snapshot scene() {
        SceneBuilder scene;
        scene.add(plane(5), {glm::rotate(at(0, uniform(-0.1, 0.1), 0), uniform(-0.1, 0.1), glm::dvec3(1, 0, 0))});
        scene.camera({uniform(-2, 2), uniform(2, 5), uniform(3, 5)}, {0, 0.3, 0});
        Light& light = scene.get().light;
        light = {kinds[static_cast<std::size_t>(GetParam() % kindCount)],
                 inBox({-1, 2.2, -1}, {1, 4, 1}),
                 {0, -1, 0},
                 {uniform(0.2, 2), uniform(-0.2, 0.2), uniform(-1, 1)},
                 {uniform(-1, 1), uniform(-0.2, 0.2), 1.1}};
        if (light.kind == LightKind::Line) light.v = glm::dvec3(0);
        if (light.kind == LightKind::Disk) light.v = glm::cross(light.u, glm::dvec3(0.1, 1, -0.1));
        scene.add(box({0.6, 0.9, 0.3}), {somewhere(), somewhere(), at(0.3, 0.4, 0.2)});
        if (GetParam() % 2 == 0) scene.add(soup(12, {-1.5, -0.1, -1.5}, {1.5, 3.3, 1.5}, random_));
        if (GetParam() % 3 == 0)
            scene.add(bumpy(0.4, 0.15, 180, static_cast<std::uint32_t>(GetParam())),
                      {somewhere(), glm::scale(somewhere(), {-1, 1, 2})});
        return scene.get();
    }
};

TEST_P(RandomAreaScene, FastAndExactAgree) {
    const Snapshot snapshot = scene();
    const glm::ivec2 size(16, 16);
    const PrimaryHits primary = primaryHits(snapshot, size);
    const AreaScene area(snapshot);
    std::vector<glm::ivec2> pixels;
    for (int i = 0; i < size.x * size.y && pixels.size() < 100; ++i)
        if (primary.surface(i % size.x, i / size.x) == Surface::Receiver) pixels.emplace_back(i % size.x, i / size.x);
    EXPECT_GE(pixels.size(), 85U);

    std::vector<VisibleFraction> fast(pixels.size()), exact(pixels.size());
    inParallel(static_cast<int>(pixels.size()), availableThreads(), [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        fast[index] = area.fraction(pixels[index], size, primary);
        exact[index] = area.exactFraction(pixels[index], size, primary);
    });
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        ASSERT_NEAR(fast[i].low, exact[i].low, fastError) << pixels[i].x << " " << pixels[i].y;
        ASSERT_NEAR(fast[i].high, exact[i].high, fastError) << pixels[i].x << " " << pixels[i].y;
    }
}

TEST_P(RandomAreaScene, TheFractionOfATinyLightIsTheHardLabel) {
    Snapshot snapshot = scene();
    snapshot.light.u *= 1e-7;
    snapshot.light.v *= 1e-7;
    const glm::ivec2 size(32, 32);
    const PrimaryHits primary = primaryHits(snapshot, size);
    Reference soft;
    AreaScene(snapshot).label(size, primary, soft);
    snapshot.light = snapshot.light.centreOnly();
    const Reference hard = rayLabels(ExactScene(snapshot), size, primary);
    int between = 0;
    for (std::size_t i = 0; i < soft.visibility.size(); ++i) {
        if (soft.visibility[i] > 0 && soft.visibility[i] < 1)
            ++between;
        else
            EXPECT_EQ(soft.visibility[i], hard.visibility[i]) << i;
    }
    EXPECT_LE(between, 1); // its penumbra is some 1e-7 m wide, a pixel a tenth of a metre
}

// 22 scenes of at least 85 points; with the lattice more than 2,000.
INSTANTIATE_TEST_SUITE_P(Seeds, RandomAreaScene, ::testing::Range(0, 22));

TEST(AreaLattice, FastAndExactAgreeWhereEdgesCoincideWithEdgesCornersAndTheLight) {
    // Coordinates are eighths at heights ½, 1, 2 under a light of side 2 at height 4, so that from points at eighths
    // projected corners fall on lattice points of the light, on its sides and corners and on each other.
    std::mt19937 random(7);
    const auto eighth = [&](int low, int high) {
        return static_cast<float>(std::uniform_int_distribution<int>(low, high)(random)) / 8;
    };
    int points = 0, partly = 0;
    for (int i = 0; i < 240; ++i) {
        SceneBuilder scene = litGround(kinds[static_cast<std::size_t>(i % kindCount)]);
        for (int k = 0; k < 5; ++k) {
            const std::array heights{0.5F, 1.0F, 2.0F};
            Mesh triangle;
            do triangle = {{}, {{0, 1, 2}}, false};
            while ([&] {
                for (int corner = 0; corner < 3; ++corner)
                    triangle.positions.emplace_back(
                        eighth(-4, 4), heights[static_cast<std::size_t>((k + (i % 2) * corner) % 3)], eighth(-4, 4));
                const std::vector<glm::vec3>& p = triangle.positions;
                return glm::cross(p[1] - p[0], p[2] - p[0]) == glm::vec3(0);
            }());
            scene.add(triangle);
        }
        const float x = eighth(-2, 2), z = eighth(-2, 2);
        const VisibleFraction found = fractionAt(scene.get(), {x, 0, z});
        ++points;
        partly += found.high > 0 && found.low < 1;
    }
    EXPECT_EQ(points, 240);
    EXPECT_GT(partly, 120);
}

/// The share of `side`² light points, the centres of equal cells in Light::sample's parameters, that a shadow ray reaches.
Image<double> rayFractions(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, int side) {
    Image<double> result(size.x, size.y);
    Snapshot at = snapshot;
    for (int i = 0; i < side * side; ++i) {
        const bool line = snapshot.light.kind == LightKind::Line;
        const int column = line ? i : i % side, columns = line ? side * side : side, row = i / side;
        const glm::dvec2 cell((column + 0.5) / columns, (row + 0.5) / side);
        at.light = snapshot.light.centreOnly();
        at.light.centre = snapshot.light.sample(cell);
        const Reference labels = rayLabels(ExactScene(at, 1), size, primary);
        for (std::size_t p = 0; p < result.size(); ++p) result[p] += labels.visibility[p] / (1.0 * side * side);
    }
    return result;
}

class AreaAgainstRays : public ::testing::TestWithParam<LightKind> {};

TEST_P(AreaAgainstRays, AgreeWithinTheGridsError) {
    SceneBuilder scene = litGround(GetParam());
    std::mt19937 random(3);
    scene.add(box({0.9, 0.3, 0.4}), {glm::rotate(at(0.1, 1.3, 0), 0.6, glm::dvec3(0.2, 1, 0))});
    scene.add(soup(5, {-1, 1, -1}, {1, 5, 1}, random)).camera({1, 2, 3}, {0, 0, 0});
    const glm::ivec2 size(6, 6);
    const PrimaryHits primary = primaryHits(scene.get(), size);
    const Image<double> rays = rayFractions(scene.get(), size, primary, 64);
    const AreaScene area(scene.get());
    int partly = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != Surface::Receiver) continue;
            const VisibleFraction f = area.fraction({x, y}, size, primary);
            partly += f.low > 0 && f.high < 1;
            // Some ten edges cross 64 cells or so each; a crossed cell errs by 0.3 of 1/4096 or so, at random: 1.9e-3 rms.
            EXPECT_NEAR(0.5 * (f.low + f.high), rays(x, y), 0.01) << x << " " << y;
        }
    EXPECT_GT(partly, 6);
}

INSTANTIATE_TEST_SUITE_P(Lights, AreaAgainstRays, ::testing::Values(LightKind::Rectangle, LightKind::Disk, LightKind::Line),
                         [](const auto& parameter) { return std::string(name(parameter.param)); });

} // namespace
} // namespace shadowbench::groundtruth::testing
