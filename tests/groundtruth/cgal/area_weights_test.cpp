// Shares of irradiance and solid angle against closed forms, and where their sums would cancel.
#include "base/error.h"
#include "base/random.h"
#include "groundtruth/cgal/area/area_weights.h"
#include "tests/support/area_scenes.h"

#include <numbers>

namespace shadowbench::groundtruth::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array weighedShares{Share::Irradiance, Share::SolidAngle};
constexpr LightPart square{-0.5, 0.5, -0.5, 0.5, -0.5, 0.5};

/// A light of sides u and v around `centre` as the point sees it on the horizontal ground.
LightWeights weightsAt(const glm::dvec3& point, const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v) {
    const Triangle ground{point + glm::dvec3(1, 0, -1), point + glm::dvec3(-1, 0, -1), point + glm::dvec3(0, 0, 2)};
    return {{LightKind::Rectangle, centre, {0, -1, 0}, u, v}, {{point + glm::dvec3(0, 1, 0), {0, -1, 0}}, ground}};
}

/// Irradiance of unit radiance from a rectangle [0, x] × [0, z] at height y, in the planes of the axes; odd in x and z.
/// Howell, A catalog of radiation heat transfer configuration factors, B-3.
double parallelIrradiance(double x, double y, double z) {
    const double a = x / y, b = z / y, ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return 0.5 * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
}
double parallelSolidAngle(double x, double y, double z) { return std::atan(x * z / (y * std::sqrt(x * x + y * y + z * z))); }
template <typename Corner>
double between(const Corner& corner, double x0, double x1, double y, double z0, double z1) {
    return corner(x1, y, z1) - corner(x0, y, z1) - corner(x1, y, z0) + corner(x0, y, z0);
}

/// Seen straight down at `point`.
VisibleFraction shareAt(const Snapshot& snapshot, const glm::dvec3& point, Share share) {
    const Snapshot seen = looksDownOn(snapshot, point);
    return AreaScene(seen).fraction({0, 0}, {1, 1}, primaryHits(seen, {1, 1}), share);
}

double relativeError(double found, double expected) { return std::abs(found / expected - 1); }

TEST(LightWeights, OfAParallelRectangleAreTheKnownFormFactors) {
    for (const double height : {0.01, 0.5, 4.0, 100.0})
        for (const glm::dvec3 aside : {glm::dvec3(0), glm::dvec3(0.3, 0, -0.9), glm::dvec3(7, 0, 2)}) {
            const LightWeights weights = weightsAt({0, 0, 0}, aside + glm::dvec3(0, height, 0), {2, 0, 0}, {0, 0, 3});
            const auto known = [&](const auto& corner) {
                return between(corner, aside.x - 1, aside.x + 1, height, aside.z - 1.5, aside.z + 1.5);
            };
            const double loss = 4e-15 * std::max(1.0, 1 / height); // differences of terms up to 1, and what nearness costs
            EXPECT_NEAR(weights.irradiance(square), known(parallelIrradiance), loss);
            EXPECT_NEAR(weights.solidAngle(square), known(parallelSolidAngle), loss);
        }
}

TEST(LightWeights, OfAWallThatStandsOnTheGroundAreTheKnownFormFactor) {
    // A wall [0, 2] × [0, 1] at the distance 0.7: Howell's B-4.
    const double width = 2, height = 1, away = 0.7, slant = std::hypot(height, away);
    const LightWeights weights = weightsAt({0, 0, 0}, {width / 2, height / 2, away}, {width, 0, 0}, {0, height, 0});
    EXPECT_NEAR(weights.irradiance(square), 0.5 * (std::atan(width / away) - away / slant * std::atan(width / slant)),
                1e-14);
}

TEST(LightWeights, HoldWhereTheLightGrazesTheReceiver) {
    // The same wall at a height of `low`: to the first order the square of its height counts.
    const double width = 2, away = 0.7;
    const double factor = (std::atan(width / away) / away + width / (width * width + away * away)) / (4 * away);
    for (const double height : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const LightWeights weights = weightsAt({0, 0, 0}, {width / 2, height / 2, away}, {width, 0, 0}, {0, height, 0});
        EXPECT_LT(relativeError(weights.irradiance(square), height * height * factor), 4 * height * height + 1e-12)
            << height;
    }
}

/// Positions that are hard: near the light, near its corner, far away, and almost in its plane.
std::vector<LightWeights> hardPlaces() {
    std::vector<LightWeights> places;
    for (const double height : {1e-9, 1e-4, 0.03, 1.0, 30.0, 1e5})
        for (const glm::dvec3 aside : {glm::dvec3(0.1, 0, 0.2), glm::dvec3(0.999999, 0, 0.4), glm::dvec3(3, 0, 1)})
            places.push_back(weightsAt({0, 0, 0}, aside + glm::dvec3(0, height, 0), {2, 0, 0}, {0, 0, 1}));
    for (const double height : {1e-6, 0.01, 1.0}) // walls that rise from the tangent plane, also from nearby
        for (const double away : {1e-6, 0.01, 1.0, 100.0})
            places.push_back(weightsAt({0, 0, 0}, {0.2, 0.5 * height, away}, {2, 0, 0.3}, {0, height * (1 - 1e-9), 0}));
    return places;
}

TEST(LightWeights, PartsAddUpToTheWhole) {
    Random random(3);
    for (const LightWeights& weights : hardPlaces())
        for (const Share share : weighedShares) {
            double low = -0.5, sum = 0;
            while (low < 0.5) { // rows of random heights, cut at random slanted edges
                const double high = std::min(0.5, low + random.uniform(0.0003, 0.1));
                const double below = random.uniform(-0.5, 0.5), above = random.uniform(-0.5, 0.5);
                sum += weights.of(share, {low, high, -0.5, below, -0.5, above});
                sum += weights.of(share, {low, high, below, 0.5, above, 0.5});
                low = high;
            }
            const double whole = weights.of(share, square);
            EXPECT_GT(whole, 0);
            EXPECT_LT(relativeError(sum, whole), 1e-11) << static_cast<int>(share);
        }
}

TEST(LightWeights, OfTinyPartsAreInProportionToTheirArea) {
    constexpr double side = 1e-7;
    const auto tiny = [](double share) { // of the side
        return LightPart{0.25, 0.25 + share * side, 0.125, 0.125 + share * side, 0.125, 0.125 + share * side};
    };
    for (const LightWeights& weights : {weightsAt({0, 0, 0}, {0.3, 4, 0.1}, {2, 0, 0}, {0, 0, 1}),
                                        weightsAt({0, 0, 0}, {0.3, 1, 9}, {2, 0, 0}, {0, 1, 0})})
        for (const Share share : weighedShares) {
            const double whole = weights.of(share, tiny(1));
            EXPECT_NEAR(weights.of(share, tiny(0.5)) / whole, 0.25, 1e-6);
            EXPECT_LT(whole / weights.of(share, square), side * side * weights.densest(share));
            EXPECT_GT(whole, 0);
        }
}

TEST(WeighedShare, IsExactlyOneWithoutOccludersAndZeroInTheUmbra) {
    for (const LightKind kind : {LightKind::Rectangle, LightKind::Disk})
        for (const Share share : weighedShares) {
            SceneBuilder scene = litGround(kind);
            const VisibleFraction lit = shareAt(scene.get(), {0.1, 0, 0.2}, share);
            EXPECT_EQ(lit.low, 1);
            EXPECT_EQ(lit.high, 1);
            scene.add(plate(-2, 2, 2, -2, 2));
            EXPECT_EQ(shareAt(scene.get(), {0.1, 0, 0.2}, share).high, 0);
        }
}

TEST(WeighedShare, IsHalfWhereTheHiddenHalfMirrorsTheOther) {
    for (const LightKind kind : {LightKind::Rectangle, LightKind::Disk})
        for (const Share share : weighedShares) {
            SceneBuilder scene = litGround(kind);
            scene.add(plate(0, 20, 2, -20, 20));
            for (const double z : {0.0, 0.7, 2.0}) {
                const VisibleFraction found = shareAt(scene.get(), {0, 0, z}, share);
                EXPECT_LE(found.low, 0.5 + 1e-12);
                EXPECT_GE(found.high, 0.5 - 1e-12);
                EXPECT_LE(found.high - found.low, kind == LightKind::Disk ? 1e-4 : 0);
            }
        }
}

TEST(WeighedShare, DiffersFromTheAreasByAKnownAmount) {
    // A point that stands aside sees the farther half, which brings less than half.
    SceneBuilder scene = litGround();
    scene.add(plate(-20, -1, 2, -20, 20)); // from x = −2 it ends below the light's middle
    const glm::dvec3 point(-2, 0, 0.5);
    const auto share = [&](const auto& corner) {
        return between(corner, 2, 3, 4, -1.5, 0.5) / between(corner, 1, 3, 4, -1.5, 0.5); // seen from the point
    };
    const double area = fractionAt(scene.get(), point).low;
    EXPECT_NEAR(area, 0.5, 1e-14);
    const double irradiance = share(parallelIrradiance), solidAngle = share(parallelSolidAngle);
    EXPECT_NEAR(shareAt(scene.get(), point, Share::Irradiance).low, irradiance, 1e-12);
    EXPECT_NEAR(shareAt(scene.get(), point, Share::SolidAngle).low, solidAngle, 1e-12);
    EXPECT_LT(irradiance, solidAngle - 0.02);
    EXPECT_LT(solidAngle, area - 0.05);
}

TEST(WeighedShare, OfALightThatIsFarAwayIsThatOfItsArea) {
    SceneBuilder scene = litGround();
    scene.get().light.centre.y = 4000;
    scene.add(plate(0.1F, 20, 2, -20, 20)).add(plate(-3, 3, 1000, 0.03F, 3));
    const glm::dvec3 point(0.0997, 0, 0.125);
    const double area = fractionAt(scene.get(), point).low;
    EXPECT_GT(area, 0.05);
    EXPECT_LT(area, 0.95);
    for (const Share share : weighedShares) EXPECT_NEAR(shareAt(scene.get(), point, share).low, area, 1e-6);
}

TEST(WeighedShare, OfALineIsAnError) {
    const Snapshot seen = looksDownOn(litGround(LightKind::Line).get(), {0, 0, 0});
    const PrimaryHits primary = primaryHits(seen, {1, 1});
    Reference out;
    EXPECT_THROW((void)AreaScene(seen).fraction({0, 0}, {1, 1}, primary, Share::SolidAngle), InternalError);
    EXPECT_THROW(AreaScene(seen).label({1, 1}, primary, out, {}, Share::Irradiance), InternalError);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
