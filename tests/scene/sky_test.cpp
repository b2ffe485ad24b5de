// Skies, suns and spherical harmonics against closed forms, and environment lights as scene files write them.
#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/random.h"
#include "base/temporary_folder.h"
#include "scene/load/load.h"
#include "scene/sky.h"
#include "scene/spherical_harmonics.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace shadowbench {
namespace {

constexpr double kPi = std::numbers::pi;

/// ∫ f dω by the midpoint rule in height and longitude, both of which divide the sphere evenly.
double overSphere(int rows, const std::function<double(const glm::dvec3&)>& f) {
    double sum = 0;
    for (int row = 0; row < rows; ++row) {
        const double y = 1 - 2 * (row + 0.5) / rows, radius = std::sqrt(1 - y * y);
        for (int column = 0; column < 2 * rows; ++column) {
            const double angle = kPi * (column + 0.5) / rows;
            sum += f({radius * std::cos(angle), y, radius * std::sin(angle)});
        }
    }
    return sum * 4 * kPi / (2.0 * rows * rows);
}

glm::dvec3 anyDirection(Random& random) {
    const double y = random.uniform(-1, 1), angle = random.uniform(0, 2 * kPi), radius = std::sqrt(1 - y * y);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

TEST(SphericalHarmonics, OfThreeBandsAreThePolynomialsOfRamamoorthiAndHanrahan) {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 d = anyDirection(random);
        const std::vector<double> published{0.282095,
                                            0.488603 * d.y,
                                            0.488603 * d.z,
                                            0.488603 * d.x,
                                            1.092548 * d.x * d.y,
                                            1.092548 * d.y * d.z,
                                            0.315392 * (3 * d.z * d.z - 1),
                                            1.092548 * d.x * d.z,
                                            0.546274 * (d.x * d.x - d.y * d.y)};
        const std::vector<double> ours = harmonics(d, 3);
        ASSERT_EQ(ours.size(), published.size());
        for (std::size_t k = 0; k < ours.size(); ++k)
            EXPECT_NEAR(ours[k], published[k], 1e-6) << k; // six digits are printed
    }
}

TEST(SphericalHarmonics, AreOrthonormalOverTheSphere) {
    constexpr std::size_t kCount = 36;
    std::vector<double> products(kCount * kCount);
    const double all = overSphere(128, [&](const glm::dvec3& d) {
        const std::vector<double> values = harmonics(d, 6);
        for (std::size_t i = 0; i < products.size(); ++i) products[i] += values[i / kCount] * values[i % kCount];
        return 1;
    });
    const double each = all / (2 * 128 * 128); // solid angle of a direction
    for (std::size_t i = 0; i < products.size(); ++i)
        EXPECT_NEAR(each * products[i], i / kCount == i % kCount ? 1 : 0, 5e-3) << i; // the midpoint rule at 128 rows
}

TEST(SphericalHarmonics, ObeyTheAdditionTheorem) {
    Random random(6);
    constexpr int kBands = 12;
    for (int i = 0; i < 20; ++i) {
        const std::vector<double> values = harmonics(anyDirection(random), kBands);
        for (int l = 0; l < kBands; ++l) { // Σ_m Y² = (2l + 1)/4π in every direction
            double sum = 0;
            for (int m = -l; m <= l; ++m) sum += std::pow(values[static_cast<std::size_t>(l) * (l + 1) + m], 2);
            EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi), 1e-12) << l;
        }
    }
}

TEST(SphericalHarmonics, ComeInSquareNumbers) {
    EXPECT_EQ(harmonicBands(1), 1);
    EXPECT_EQ(harmonicBands(25), 5);
    for (const std::size_t count : {0U, 2U, 8U, 26U}) EXPECT_EQ(harmonicBands(count), 0) << count;
}

TEST(Skies, OfAnImageLieAsOpenExrDefinesLatitudeLongitudeMaps) {
    const ImageSky sky{Image<float>(8, 4, 1)};
    const auto expectNear = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), 1e-15); };
    expectNear(sky.direction({3, 0}), {0, 1, 0});  // the top row is the zenith
    expectNear(sky.direction({4, 2}), {0, 0, 1});  // the middle is +z
    expectNear(sky.direction({2, 2}), {1, 0, 0});  // left of it +x
    expectNear(sky.direction({0, 2}), {0, 0, -1}); // the edge is behind
    expectNear(sky.direction({8, 2}), {0, 0, -1});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(sky.pixel(sky.direction({x + 0.5, y + 0.5})), glm::ivec2(x, y));
    EXPECT_EQ(sky.pixel({0, 1, 0}).y, 0);
    EXPECT_EQ(sky.pixel({0, -1, 0}).y, 3);
}

TEST(Skies, HaveTheRadianceOfTheirKind) {
    Random random(7);
    ImageSky image{Image<float>(4, 2, 0.25F)};
    image.radiance(1, 0) = 3;                                                        // up, on the side of +x and +z
    const HarmonicSky fromAbove{{std::sqrt(4 * kPi), std::sqrt(4 * kPi / 3), 0, 0}}; // 1 + y
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 d = anyDirection(random);
        EXPECT_EQ(radiance(ConstantSky{0.7}, d), 0.7);
        EXPECT_NEAR(radiance(fromAbove, d), 1 + d.y, 1e-12);
        EXPECT_EQ(radiance(image, d), d.y > 0 && d.x > 0 && d.z > 0 ? 3 : 0.25);
    }
    EXPECT_EQ(radiance(HarmonicSky{{0, 1, 0, 0}}, {0, -1, 0}), 0); // what is negative counts as 0
}

TEST(Skies, CountByTheCosineAboveTheTangentPlane) {
    EXPECT_DOUBLE_EQ(irradianceWeight({0, 0.6, 0.8}, {0, 1, 0}), 0.6);
    EXPECT_EQ(irradianceWeight({0, -0.6, 0.8}, {0, 1, 0}), 0);
    const auto irradiance = [](const Sky& sky, const glm::dvec3& normal) {
        return overSphere(400, [&](const glm::dvec3& d) { return radiance(sky, d) * irradianceWeight(d, normal); });
    };
    EXPECT_NEAR(irradiance(ConstantSky{2}, {0.6, 0.8, 0}), 2 * kPi, 1e-3);
    // 1 + y has the irradiance π (1 + ⅔ n.y) (Ramamoorthi and Hanrahan: bands 0 and 1 are weighed by π and 2π/3).
    const HarmonicSky fromAbove{{std::sqrt(4 * kPi), std::sqrt(4 * kPi / 3), 0, 0}};
    EXPECT_NEAR(irradiance(fromAbove, {0.6, 0.8, 0}), kPi * (1 + 2.0 / 3 * 0.8), 1e-3);
}

TEST(Suns, AreDisksOfTheirAngularDiameter) {
    const Sun sun{glm::normalize(glm::dvec3(1, 2, -1)), 20, 5};
    const glm::dvec3 side = glm::normalize(glm::cross(sun.direction, glm::dvec3(0, 1, 0)));
    const auto away = [&](double degrees) {
        return std::cos(glm::radians(degrees)) * sun.direction + std::sin(glm::radians(degrees)) * side;
    };
    EXPECT_TRUE(sun.contains(sun.direction));
    EXPECT_TRUE(sun.contains(away(9.999)));
    EXPECT_FALSE(sun.contains(away(10.001)));
    EXPECT_FALSE(sun.contains(-sun.direction));
    EXPECT_NEAR(sun.solidAngle(), 2 * kPi * (1 - std::cos(glm::radians(10.0))), 1e-12);
    EXPECT_NEAR((Sun{{0, 1, 0}, 180, 1}.solidAngle()), 2 * kPi, 1e-12);
    EXPECT_NEAR(overSphere(400, [&](const glm::dvec3& d) { return sun.contains(d) ? 1.0 : 0.0; }), sun.solidAngle(), 1e-3);
}

TEST(EnvironmentLights, HaveAMeanDirection) {
    const auto expectNear = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), 1e-12); };
    const Sun east{{1, 0, 0}, 5, 3}, west{{-1, 0, 0}, 5, 3};
    expectNear(meanDirection({ConstantSky{2}, {}}), {0, 1, 0}); // from everywhere: from above
    expectNear(meanDirection({ConstantSky{2}, {east}}), {1, 0, 0});
    expectNear(meanDirection({ConstantSky{0}, {east, west}}), {0, 1, 0});
    expectNear(meanDirection({HarmonicSky{{1, 0.1, 0.2, -0.2}}, {}}), glm::dvec3(-2, 1, 2) / 3.0);
    expectNear(meanDirection({ImageSky{Image<float>(64, 32, 1)}, {}}), {0, 1, 0});
    ImageSky image{Image<float>(64, 32)};
    image.radiance(40, 9) = 1;
    expectNear(meanDirection({image, {}}), image.direction({40.5, 9.5}));
}

TEST(EnvironmentLights, AreEqualByWhatTheyHold) {
    const Light light = environmentLight({ConstantSky{1}, {Sun{}}});
    EXPECT_EQ(light, environmentLight({ConstantSky{1}, {Sun{}}}));
    EXPECT_NE(light, environmentLight({ConstantSky{2}, {Sun{}}}));
    EXPECT_NE(light, environmentLight({ConstantSky{1}, {}}));
    EXPECT_NE(light, environmentLight({ConstantSky{1}, {Sun{{0, 1, 0}, 1, 1}}}));
    EXPECT_NE(light, Light{});
    EXPECT_TRUE(light.isEnvironment());
    EXPECT_FALSE(light.isArea());
    EXPECT_EQ(name(light.kind), "environment");
}

TEST(EnvironmentLights, LightPicturesFromTheirMeanDirection) {
    const Light light = environmentLight({ConstantSky{1}, {Sun{{0, 0.6, 0.8}, 5, 100}}});
    EXPECT_EQ(light.centreOnly().kind, LightKind::Directional);
    EXPECT_EQ(light.centreOnly().environment, nullptr);
    EXPECT_LT(glm::distance(light.centreOnly().direction, glm::dvec3(0, -0.6, -0.8)), 1e-12);
    EXPECT_EQ(light.homogeneous(), light.centreOnly().homogeneous());
}

class EnvironmentFiles : public testing::Test {
protected:
    [[nodiscard]] Scene parsed(const std::string& light) const {
        return parseScene(
            "title = \"x\"\ncamera = { eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
            "light = { kind = \"environment\", " +
                light + " }\n[[object]]\nmesh = { plane = { half = 2 } }\n",
            folder_.path() / "x.toml", Profile::Gate);
    }

    [[nodiscard]] EnvironmentLight environment(const std::string& light) const { return *parsed(light).light.environment; }

    /// What the loader says, without the file's folder.
    [[nodiscard]] std::string messageOf(const std::string& light) const {
        try {
            static_cast<void>(parsed(light));
        } catch (const BadInput& error) {
            const std::string message = error.what(), file = (folder_.path() / "x.toml").string();
            return message.starts_with(file) ? message.substr(file.size()) : message;
        }
        return "";
    }

    void write(const std::string& name, const Image<float>& red, const Image<float>& green, const Image<float>& blue) const {
        writeExr(folder_.path() / name, {{"R", &red}, {"G", &green}, {"B", &blue}});
    }

    const TemporaryFolder folder_;
};

TEST_F(EnvironmentFiles, GiveAConstantSkyAndSuns) {
    const EnvironmentLight read =
        environment("sky = { constant = 0.5 }, suns = [{ direction = [0, 2, 0], diameter = 5, radiance = 40 }]");
    EXPECT_EQ(read, (EnvironmentLight{ConstantSky{0.5}, {Sun{{0, 1, 0}, 5, 40}}}));
    const Scene scene = parsed("sky = { constant = 1 }");
    EXPECT_EQ(snapshot(scene, 0).light, scene.light);
    EXPECT_EQ(snapshot(scene, 0).light.direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.referenceSamples, 4096); // directions of all the sky
    EXPECT_EQ(scene.movingReferenceSamples, 1024);
}

TEST_F(EnvironmentFiles, GiveScaledHarmonics) {
    EXPECT_EQ(environment("sky = { harmonics = [1, 0.25, 0, 0], scale = 2 }").sky, Sky(HarmonicSky{{2, 0.5, 0, 0}}));
    EXPECT_EQ(environment("sky = { harmonics = [1] }").sky, Sky(HarmonicSky{{1}}));
}

TEST_F(EnvironmentFiles, GiveAScaledImageBesideTheScene) {
    Image<float> red(4, 2, 1), green(4, 2, 0), blue(4, 2, 0);
    green(2, 1) = 1;
    blue(3, 0) = 1;
    write("sky.exr", red, green, blue);
    const EnvironmentLight colours = environment("sky = { image = \"sky.exr\", scale = 10 }");
    const auto& sky = std::get<ImageSky>(colours.sky);
    EXPECT_FLOAT_EQ(sky.radiance(0, 0), 2.126F); // luminance by Rec. 709
    EXPECT_FLOAT_EQ(sky.radiance(2, 1), 9.278F);
    EXPECT_FLOAT_EQ(sky.radiance(3, 0), 2.848F);
    writeExr(folder_.path() / "grey.exr", {{"Y", &red}});
    EXPECT_EQ(environment("sky = { image = \"grey.exr\" }").sky, Sky(ImageSky{red}));
}

TEST_F(EnvironmentFiles, AreRefusedWithFileLineAndKey) {
    const Image<float> square(4, 4, 1), black(4, 2, 0);
    Image<float> negative(4, 2, 1);
    negative(1, 1) = -1;
    Image<float> bright(4, 2, 3e38F);
    write("square.exr", square, square, square);
    write("black.exr", black, black, black);
    write("negative.exr", negative, negative, negative);
    writeExr(folder_.path() / "bright.exr", {{"Y", &bright}});
    writeExr(folder_.path() / "depth.exr", {{"Z", &square}});
    writeExr(folder_.path() / "red.exr", {{"R", &black}});
    writeExr(folder_.path() / "yellow.exr", {{"R", &black}, {"G", &black}});
    const Image<float> none(4, 2, std::numeric_limits<float>::quiet_NaN());
    writeExr(folder_.path() / "none.exr", {{"Y", &none}});
    writeFile(folder_.path() / "text.exr", "no image");

    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"suns = []", ":3: light.sky: missing"},
        {"sky = {}", ":3: light.sky: expected one of constant, harmonics and image"},
        {"sky = { constant = 1, harmonics = [1] }", ":3: light.sky: expected one of constant, harmonics and image"},
        {"sky = { constnat = 1 }", ":3: light.sky.constnat: unknown key (did you mean \"constant\"?)"},
        {"sky = { constant = -1 }", ":3: light.sky.constant: expected a radiance of 0 or more, got -1"},
        {"sky = { constant = 1, scale = 2 }", ":3: light.sky.scale: unknown key"},
        {"sky = { constant = 0 }", ":3: light.sky: is black, and there is no sun"},
        {"sky = { constant = 0 }, suns = []", ":3: light.sky: is black, and there is no sun"},
        {"sky = { constant = 1 }, centre = [0, 1, 0]", ":3: light.centre: unknown key"},
        {"sky = { harmonics = [1, 0] }", ":3: light.sky.harmonics: expected a square number of coefficients"},
        {"sky = { harmonics = [] }", ":3: light.sky.harmonics: expected a square number of coefficients"},
        {"sky = { harmonics = [1, \"a\", 0, 0] }", ":3: light.sky.harmonics[2]: expected a number"},
        {"sky = { harmonics = [1, 2, 0, 0] }", ":3: light.sky.harmonics: the radiance is negative towards"},
        {"sky = { harmonics = [-1] }", ":3: light.sky.harmonics: the radiance is nowhere above 0"},
        {"sky = { harmonics = [1], scale = 0 }", ":3: light.sky.scale: expected a number above 0, got 0"},
        {"sky = { image = \"sky.png\" }", ":3: light.sky.image: expected an OpenEXR file"},
        {"sky = { image = \"missing.exr\" }", ":3: light.sky.image: cannot read image"},
        {"sky = { image = \"none.exr\" }", ":3: light.sky.image: a pixel has the radiance nan"},
        {"sky = { image = \"red.exr\" }", ":3: light.sky.image: cannot read channel \"Y\""},
        {"sky = { image = \"yellow.exr\" }", ":3: light.sky.image: cannot read channel \"Y\""},
        {"sky = { image = \"text.exr\" }", ":3: light.sky.image: cannot read image"},
        {"sky = { image = \"depth.exr\" }", ":3: light.sky.image: cannot read channel \"Y\""},
        {"sky = { image = \"square.exr\" }",
         ":3: light.sky.image: expected an equirectangular image, twice as wide as high"},
        {"sky = { image = \"black.exr\" }", ":3: light.sky: is black, and there is no sun"},
        {"sky = { image = \"negative.exr\" }", ":3: light.sky.image: a pixel has the radiance -1"},
        {"sky = { image = \"bright.exr\", scale = 10 }",
         ":3: light.sky.image: the scaled radiance of a pixel is not finite"},
        {"sky = { constant = 1 }, suns = [{ direction = [0, 0, 0], diameter = 5, radiance = 1 }]",
         ":3: light.suns[1].direction: expected a vector other than zero"},
        {"sky = { constant = 1 }, suns = [{ direction = [0, 1, 0], diameter = 181, radiance = 1 }]",
         ":3: light.suns[1].diameter: expected degrees, at most 180"},
        {"sky = { constant = 1 }, suns = [{ direction = [0, 1, 0], diameter = 5, radiance = 0 }]",
         ":3: light.suns[1].radiance: expected a number above 0, got 0"},
        {"sky = { constant = 1 }, suns = [{ direction = [0, 1, 0], radiance = 1 }]", ":3: light.suns[1].diameter: missing"},
    };
    for (const auto& [light, message] : mistakes) EXPECT_EQ(messageOf(light).substr(0, message.size()), message) << light;
}

TEST_F(EnvironmentFiles, HaveNoMoreCoefficientsThanAnyoneMeans) {
    std::string coefficients = "1";
    for (int i = 1; i < 17 * 17; ++i) coefficients += ", 0";
    EXPECT_EQ(messageOf("sky = { harmonics = [" + coefficients + "] }"),
              ":3: light.sky.harmonics: expected a square number of coefficients (1, 4, 9, …, 256), got 289");
}

} // namespace
} // namespace shadowbench
