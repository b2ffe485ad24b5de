// FLIP against the paper's equations in double precision, with kernels in two dimensions, and against figures by hand.
#include "base/error.h"
#include "harness/metrics/flip.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

using Picture = Image<glm::vec3>;
using std::numbers::pi;

double flipOf(const Picture& a, const Picture& b) { return meanFlip(flipPicture(a), flipPicture(b)); }
double flipOf(const glm::vec3& a, const glm::vec3& b) { return flipOf(Picture(24, 24, a), Picture(24, 24, b)); }

/// What a difference HyAB of colours becomes. CIELab of sRGB's green and blue, as tables give it, are (87.735, −86.183,
/// 83.179) and (32.297, 79.188, −107.860); Hunt's adjustment multiplies a and b by L/100.
double redistributed(double hyab) {
    const double da = -0.87735 * 86.183 - 0.32297 * 79.188, db = 0.87735 * 83.179 + 0.32297 * 107.860;
    const double largest = std::pow(87.735 - 32.297 + std::hypot(da, db), 0.7), bend = 0.4 * largest;
    const double difference = std::pow(hyab, 0.7);
    return difference < bend ? difference * 0.95 / bend : 0.95 + 0.05 * (difference - bend) / (largest - bend);
}

double lightness(double luminance) { return 116 * std::cbrt(luminance) - 16; }

constexpr double tables = 1e-4; // the tables' digits, and floats

TEST(Flip, OfEqualPicturesIsNothing) { EXPECT_EQ(flipOf({0.1F, 0.4F, 0.7F}, {0.1F, 0.4F, 0.7F}), 0); }

// Filters leave a uniform picture as it is, and it has no feature.
TEST(Flip, OfUniformGreysIsTheDifferenceOfTheirLightness) {
    EXPECT_NEAR(flipOf(glm::vec3(0), glm::vec3(1)), redistributed(100), tables);
    EXPECT_NEAR(flipOf(glm::vec3(0), glm::vec3(1)), 0.9674, tables);
    EXPECT_NEAR(flipOf(glm::vec3(0.2F), glm::vec3(0.5F)), redistributed(lightness(0.5) - lightness(0.2)), tables);
    EXPECT_NEAR(flipOf(glm::vec3(0.5F), glm::vec3(0.5F * 1.01F)), redistributed(lightness(0.505) - lightness(0.5)), tables);
}

TEST(Flip, OfUniformColoursIsHyABWithHuntsAdjustment) {
    EXPECT_NEAR(flipOf({0, 1, 0}, {0, 0, 1}), 1, tables);
    // Red is (53.233, 80.109, 67.220); a grey has no chroma.
    const double chroma = 0.53233 * std::hypot(80.109, 67.220);
    EXPECT_NEAR(flipOf({1, 0, 0}, glm::vec3(0.5F)), redistributed(lightness(0.5) - 53.233 + chroma), tables);
}

TEST(Flip, ClampsWhatNoDisplayShows) {
    EXPECT_EQ(flipOf(glm::vec3(1), glm::vec3(3)), 0);
    EXPECT_EQ(flipOf(glm::vec3(0), glm::vec3(-1)), 0);
}

TEST(Flip, RefusesPicturesOfDifferentSizes) {
    EXPECT_THROW(flip(flipPicture(Picture(4, 4)), flipPicture(Picture(5, 4))), InternalError);
}

// ---- the paper's equations, at one pixel -----------------------------------------------------------------------------

constexpr glm::dvec3 white(0.950428545, 1, 1.088900371);

glm::dvec3 relativeOf(const glm::dvec3& rgb) {
    return glm::dvec3(0.412386564 * rgb.x + 0.357591122 * rgb.y + 0.180450859 * rgb.z,
                      0.212636793 * rgb.x + 0.715182244 * rgb.y + 0.072180963 * rgb.z,
                      0.019330610 * rgb.x + 0.119197041 * rgb.y + 0.950372720 * rgb.z) /
           white;
}

glm::dvec3 rgbOf(const glm::dvec3& relative) {
    const glm::dvec3 xyz = relative * white;
    return {3.241003275 * xyz.x - 1.537398934 * xyz.y - 0.498615861 * xyz.z,
            -0.969224334 * xyz.x + 1.875929956 * xyz.y + 0.041554224 * xyz.z,
            0.055639423 * xyz.x - 0.204011202 * xyz.y + 1.057148933 * xyz.z};
}

glm::dvec3 opponentOf(const glm::dvec3& rgb) {
    const glm::dvec3 r = relativeOf(rgb);
    return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}

glm::dvec3 huntLabOf(const glm::dvec3& rgb) {
    const auto curve = [](double t) {
        const double delta = 6.0 / 29;
        return t > std::pow(delta, 3) ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    };
    const glm::dvec3 r = relativeOf(rgb);
    const double l = 116 * curve(r.y) - 16;
    return {l, 0.01 * l * 500 * (curve(r.x) - curve(r.y)), 0.01 * l * 200 * (curve(r.y) - curve(r.z))};
}

/// Sum over a square window of weight(x, y) × value(pixel), pixels beyond the border being those on it.
template <class Weight, class Value>
double windowSum(const Picture& picture, glm::ivec2 at, int radius, const Weight& weight, const Value& value) {
    double sum = 0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const glm::ivec2 p =
                glm::clamp(at + glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(picture.width() - 1, picture.height() - 1));
            sum += weight(x, y) * value(glm::dvec3(picture(p.x, p.y)));
        }
    return sum;
}

glm::dvec3 seenAt(const Picture& picture, glm::ivec2 at, double ppd) {
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const auto channel = [&](int c, double a1, double b1, double a2, double b2) {
        const auto weight = [=](int x, int y) {
            const double square = (x * x + y * y) / (ppd * ppd);
            return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * square / b1) +
                   a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * square / b2);
        };
        const double all = windowSum(picture, at, radius, weight, [](const glm::dvec3&) { return 1.0; });
        return windowSum(picture, at, radius, weight, [c](const glm::dvec3& rgb) { return opponentOf(rgb)[c]; }) / all;
    };
    const glm::dvec3 o(channel(0, 1, 0.0047, 0, 1e-5), channel(1, 1, 0.0053, 0, 1e-5), channel(2, 34.1, 0.04, 13.5, 0.025));
    const double y = (o.x + 16) / 116;
    return huntLabOf(glm::clamp(rgbOf({y + o.y / 500, y, y - o.z / 200}), 0.0, 1.0));
}

/// How strong an edge or a point there is.
double featureAt(const Picture& picture, glm::ivec2 at, double ppd, bool edge) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto luminance = [](const glm::dvec3& rgb) { return (opponentOf(rgb).x + 16) / 116; };
    const auto along = [&](int axis) {
        const auto raw = [&](int x, int y) {
            const double t = axis == 0 ? x : y, gauss = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
            return (edge ? -t : t * t / (sigma * sigma) - 1) * gauss;
        };
        const auto one = [](const glm::dvec3&) { return 1.0; };
        const double up = windowSum(
            picture, at, radius, [&](int x, int y) { return std::max(0.0, raw(x, y)); }, one);
        const double down = windowSum(
            picture, at, radius, [&](int x, int y) { return std::max(0.0, -raw(x, y)); }, one);
        const auto weight = [&](int x, int y) { return raw(x, y) / (raw(x, y) > 0 ? up : down); };
        return windowSum(picture, at, radius, weight, luminance);
    };
    return std::hypot(along(0), along(1));
}

double flipAt(const Picture& a, const Picture& b, glm::ivec2 at, double ppd) {
    const glm::dvec3 seenA = seenAt(a, at, ppd), seenB = seenAt(b, at, ppd);
    const double colours = redistributed(std::abs(seenA.x - seenB.x) + std::hypot(seenA.y - seenB.y, seenA.z - seenB.z));
    const double edges = std::abs(featureAt(a, at, ppd, true) - featureAt(b, at, ppd, true));
    const double points = std::abs(featureAt(a, at, ppd, false) - featureAt(b, at, ppd, false));
    return std::pow(colours, 1 - std::sqrt(std::max(edges, points) / std::sqrt(2.0)));
}

/// Colours without order, of which `share` are another colour in the second.
struct Pair {
    Picture a{48, 37}, b{48, 37};
    explicit Pair(int every) {
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) {
                a(x, y) = glm::vec3((x * 7 + y * 13) % 17, (x * y) % 11, (3 * x + y * y) % 23) / glm::vec3(16, 10, 22);
                b(x, y) = (x + 5 * y) % every == 0 ? glm::vec3(1) - a(x, y) : a(x, y);
            }
    }
};

constexpr double floats = 2e-4; // sums of some hundred products in single precision, under roots

void expectTheEquations(const Picture& a, const Picture& b, double ppd) {
    const Image<float> map = flip(flipPicture(a, ppd), flipPicture(b, ppd));
    const int right = a.width() - 1, bottom = a.height() - 1;
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {right, 0}, {0, bottom}, {right, bottom}, {3, 20}, {24, 18}, {31, 5}})
        EXPECT_NEAR(map(at.x, at.y), flipAt(a, b, at, ppd), floats) << at.x << ", " << at.y;
}

TEST(Flip, FollowsTheEquationsAtBordersAndWithin) {
    for (const int every : {2, 7, 41}) expectTheEquations(Pair(every).a, Pair(every).b, flipPixelsPerDegree);
}

TEST(Flip, FollowsTheEquationsAtAnotherDistance) { expectTheEquations(Pair(7).a, Pair(7).b, 30); }

TEST(Flip, OfAnEdgeThatIsNotThereFollowsTheEquations) {
    Picture edge(48, 37, glm::vec3(0.2F));
    for (int y = 0; y < edge.height(); ++y)
        for (int x = 24; x < edge.width(); ++x) edge(x, y) = glm::vec3(0.6F);
    expectTheEquations(edge, Picture(48, 37, glm::vec3(0.2F)), flipPixelsPerDegree);
}

TEST(Flip, IsTheSameInEitherOrder) {
    const Pair pair(7);
    EXPECT_EQ(flipOf(pair.a, pair.b), flipOf(pair.b, pair.a));
}

TEST(Flip, TheDefaultIsThePapersDisplay) { EXPECT_NEAR(flipPixelsPerDegree, 67.0206, 1e-4); }

// The widest filter of colours reaches three standard deviations, 3 √(0.04 / 2π²)° (Section 4.1.2), which is further than
// that of features.
TEST(Flip, OfOnePixelReachesAsFarAsTheWidestFilter) {
    const Picture grey(48, 48, glm::vec3(0.5F));
    Picture other = grey;
    other(24, 24) = {0, 0, 1};
    const Image<float> map = flip(flipPicture(grey, 60), flipPicture(other, 60));
    const int furthest = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * 60));
    EXPECT_GT(map(24 + furthest, 24), 0);
    EXPECT_EQ(map(24 + furthest + 1, 24), 0);
}

} // namespace
} // namespace shadowbench::metrics
