// Two derivations that share no decision, `polygon` and `rays`, give the same labels: on random scenes of eight kinds and on
// every built-in scene. SHADOWBENCH_STRESS=scenes or scenes:seed runs that many more random scenes.
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "scene/scene.h"
#include "tests/support/exact_comparison.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>
#include <ostream>
#include <string>

namespace shadowbench::groundtruth::testing {
namespace {

enum class Kind { Soup, Boxes, Bumpy, Broken, Instances, Straddling, LatticeBoxes, LatticeSoup };
constexpr int kinds = 8;

std::ostream& operator<<(std::ostream& out, Kind kind) { return out << static_cast<int>(kind); }

/// Degrees; the tangent of half of it is 1/4 to the bit (tested), so that rays through the centres of 2ⁿ rows are exact.
constexpr double exactFovy = 28.072486935852957;

class RandomScene {
public:
    RandomScene(Kind kind, unsigned seed) : random_(seed * kinds + static_cast<unsigned>(kind)), seed_(seed) {
        if (kind == Kind::LatticeBoxes || kind == Kind::LatticeSoup)
            latticeGround();
        else
            ground(kind == Kind::Straddling);
        switch (kind) {
        case Kind::Soup: // partly below the ground, which it passes through
            scene_.add(soup(60, {-3, -0.5F, -3}, {3, 2.5F, 3}, random_));
            break;
        case Kind::Boxes:
            scene_.add(box({1, 1, 1}), places(12));
            break;
        case Kind::Bumpy:
            scene_.add(bumpy(1, 0.4, 1500, seed), {at(uniform(-1, 1), uniform(0, 1.5), uniform(-1, 1)), at(2, 0.5, -1)});
            break;
        case Kind::Broken:
            scene_.add(broken(bumpy(1, 0.4, 600, seed)), {at(uniform(-1, 1), uniform(0, 1.5), uniform(-1, 1))});
            break;
        case Kind::Instances: // some twice at the very same place
            instances();
            break;
        case Kind::Straddling: // the ground and the light's level
            scene_.add(soup(30, {-2, -1, -2}, {2, 4, 2}, random_)).add(box({1, 3, 1}), places(3));
            break;
        case Kind::LatticeBoxes:
            latticeBoxes();
            break;
        case Kind::LatticeSoup:
            scene_.add(latticeSoup(40));
            break;
        }
    }

    [[nodiscard]] const Snapshot& get() { return scene_.get(); }
    static constexpr glm::ivec2 size{64, 64};

private:
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    /// A ground, a camera, and a light that may be point or directional, high or so low that occluders straddle its plane.
    void ground(bool lowLight) {
        scene_.add(plane(8), {glm::rotate(at(0, uniform(-0.1, 0.1), 0), uniform(-0.1, 0.1), glm::dvec3(1, 0, 0))});
        scene_.camera({uniform(-4, 4), uniform(2, 6), uniform(4, 8)}, {0, 0.5, 0});
        if (!lowLight && seed_ % 3 == 0)
            scene_.directionalLight(glm::normalize(glm::dvec3(uniform(-1, 1), -1, uniform(-1, 1))));
        else
            scene_.pointLight(
                {uniform(-2, 2), lowLight || seed_ % 3 == 1 ? uniform(1.2, 2) : uniform(4, 7), uniform(-2, 2)});
    }

    /// Pixel centres see the ground at odd multiples of 1/64 between −1 and 1, exactly; lights lie on the lattice.
    void latticeGround() {
        scene_.add(plane(8)).cameraAbove(4).get().camera.fovy = exactFovy;
        const glm::dvec3 direction(integer(-1, 1), -1, integer(-1, 1));
        if (seed_ % 3 == 0)
            scene_.get().light = {LightKind::Directional, glm::dvec3(0), direction, glm::dvec3(0), glm::dvec3(0)};
        else // 1: in the plane of vertices
            scene_.pointLight({integer(-3, 3) / 8.0, seed_ % 3 == 1 ? 4 : 1, integer(-3, 3) / 8.0});
    }

    double lattice(double reach) { return integer(-static_cast<int>(64 * reach), static_cast<int>(64 * reach)) / 64.0; }

    std::vector<glm::dmat4> places(int count) {
        std::vector<glm::dmat4> result;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 axis = glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
            const glm::dmat4 place = glm::rotate(at(uniform(-3, 3), uniform(0, 2), uniform(-3, 3)), uniform(0, 6), axis);
            const glm::dvec3 scale(uniform(0.1, 1), uniform(0.1, 1), uniform(-1, -0.1)); // mirrored
            result.push_back(glm::scale(place, scale));
        }
        return result;
    }

    void instances() {
        std::vector<glm::dmat4> result = places(6);
        result.push_back(result.front());
        scene_.add(bumpy(0.8, 0.3, 200, seed_), result).add(column(0.4, 1.5, 9), places(4));
    }

    /// With triangles missing, doubled, turned round and standing on edges of others.
    Mesh broken(Mesh mesh) {
        std::vector<glm::uvec3> kept;
        for (const glm::uvec3& t : mesh.triangles) {
            const int fate = integer(0, 9);
            if (fate == 0) continue;
            kept.push_back(fate == 1 ? glm::uvec3(t.x, t.z, t.y) : t);
            if (fate == 2) kept.push_back(t);
            if (fate != 3) continue;
            mesh.positions.push_back(1.3F * mesh.positions[t.x]);
            kept.emplace_back(t.y, t.z, static_cast<unsigned>(mesh.positions.size() - 1));
        }
        return {mesh.positions, kept, false};
    }

    /// Upright boxes on the ground, in the air and at the light's level, whose edges throw shadows through pixel centres.
    void latticeBoxes() {
        for (int i = 0; i < 6; ++i) {
            const double side = integer(1, 12) / 32.0, height = integer(1, 4) / 4.0;
            const double bottom = integer(0, 1) == 0 ? 0 : integer(0, 6) / 8.0;
            scene_.add(box({side, height, side}), {at(lattice(0.5), bottom + 0.5 * height, lattice(0.5))});
        }
        const float edge = static_cast<float>(lattice(0.25));
        scene_.add(plate(edge, edge + 0.25F, 0.75F, -0.125F, 0.125F))
            .add(plate(edge + 0.25F, edge + 0.5F, 0.75F, -0.125F, 0.125F));
    }

    /// Triangles between few points, whose shadows are lattice points, too: shared edges, coplanar overlaps, corners on the
    /// ground, in line with the light and, where it is low, at its level.
    Mesh latticeSoup(int count) {
        const Light& light = scene_.get().light;
        const bool isPoint = light.kind == LightKind::Point;
        const double middle = isPoint ? light.centre.y / 2 : 0.5;
        Mesh mesh;
        for (int i = 0; i < 24; ++i) {
            const double height = std::array{-0.5, 0.0, middle, middle, middle, 1.0}[integer(0, 5)];
            const double unit = isPoint && height == middle ? 1 / 128.0 : 1 / 64.0; // the shadow is twice as far away
            mesh.positions.emplace_back((8 * integer(-6, 6) + 1) * unit, height, (8 * integer(-6, 6) + 1) * unit);
        }
        while (static_cast<int>(mesh.triangles.size()) < count) {
            const glm::uvec3 t(integer(0, 23), integer(0, 23), integer(0, 23));
            const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            if (glm::length(glm::cross(b - a, c - a)) > 0) mesh.triangles.push_back(t);
        }
        return mesh;
    }

    std::mt19937 random_;
    unsigned seed_;
    SceneBuilder scene_;
};

constexpr unsigned seedsPerTest = 10, testsPerKind = 4; // 320 scenes

TEST(Agreement, LatticePixelsAreExact) {
    const glm::dvec3 ray = RandomScene(Kind::LatticeBoxes, 1).get().camera.ray({40.5, 8.5}, RandomScene::size);
    EXPECT_EQ(4.0 * ray, glm::dvec3(17 / 64.0, -4, -47 / 64.0));
}

class RandomScenes : public ::testing::TestWithParam<std::tuple<int, unsigned>> {};

TEST_P(RandomScenes, PolygonAndRaysAgreeToThePixel) {
    const auto kind = static_cast<Kind>(std::get<0>(GetParam()));
    const bool onLattice = kind == Kind::LatticeBoxes || kind == Kind::LatticeSoup;
    std::size_t shadowed = 0, onEdge = 0;
    for (unsigned i = 0; i < seedsPerTest; ++i) {
        const unsigned seed = 1 + std::get<1>(GetParam()) * seedsPerTest + i;
        SCOPED_TRACE(::testing::Message() << "kind " << kind << ", seed " << seed);
        const Comparison c = compareOracles(RandomScene(kind, seed).get(), RandomScene::size, 3);
        expectAgreement(c);
        EXPECT_GT(c.compared, 500U);
        shadowed += c.shadowed;
        onEdge += c.onEdge;
    }
    EXPECT_GT(shadowed, 1000U);
    if (onLattice) {
        EXPECT_GT(onEdge, 50U);
    } else {
        EXPECT_EQ(onEdge, 0U); // random numbers do not meet
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomScenes,
                         ::testing::Combine(::testing::Range(0, kinds), ::testing::Range(0U, testsPerKind)));

TEST(Agreement, StressOnDemand) {
    const char* wish = std::getenv("SHADOWBENCH_STRESS");
    // Minutes to hours, for whoever asks: the 320 random scenes above are what every run pays for.
    if (!wish) GTEST_SKIP() << "SHADOWBENCH_STRESS=scenes or scenes:seed is not set";
    const std::string text(wish);
    const std::size_t colon = text.find(':');
    const unsigned count = static_cast<unsigned>(std::stoul(text.substr(0, colon)));
    const unsigned first = colon == std::string::npos ? 1000 : static_cast<unsigned>(std::stoul(text.substr(colon + 1)));
    Comparison sum;
    for (unsigned i = 0; i < count; ++i) {
        const auto kind = static_cast<Kind>(i % kinds);
        const unsigned seed = first + i / kinds;
        SCOPED_TRACE(::testing::Message() << "kind " << kind << ", seed " << seed);
        const Comparison c = compareOracles(RandomScene(kind, seed).get(), RandomScene::size, 3);
        expectAgreement(c);
        sum.compared += c.compared;
        sum.shadowed += c.shadowed;
        sum.onEdge += c.onEdge;
    }
    std::cout << count << " scenes, " << sum.compared << " pixels compared, " << sum.shadowed << " shadowed, " << sum.onEdge
              << " on an edge\n";
}

class BuiltinScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(BuiltinScenes, PolygonAndRaysAgreeToThePixel) {
    const Scene scene = loadScene(GetParam(), Profile::Gate);
    const int scored = scene.timeline.still - 1, moving = scene.timeline.still + scene.timeline.moving / 2;
    for (const int frame : {scored, moving}) {
        SCOPED_TRACE(frame);
        Snapshot now = snapshot(scene, frame);
        now.light = now.light.centreOnly();
        const Comparison c = compareOracles(now, scene.size, 256);
        expectAgreement(c);
        RecordProperty("compared" + std::to_string(frame), static_cast<int>(c.compared));
        std::cout << GetParam() << " frame " << frame << ": " << c.compared << " pixels compared, " << c.shadowed
                  << " shadowed, " << c.onEdge << " on an edge\n";
    }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes, ::testing::ValuesIn(builtinScenes()), [](const auto& builtin) {
    std::string name = builtin.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

} // namespace
} // namespace shadowbench::groundtruth::testing
