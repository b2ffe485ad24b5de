// Precomputed radiance transfer in spherical harmonics: exact under a smooth sky, blurred under a small sun, and of a cost
// that does not depend on the light.
#include "base/error.h"
#include "harness/measure/pass_cost.h"
#include "techniques/environment/harmonic_light.h"
#include "techniques/environment/prt-sh/harmonic_transfer.h"
#include "techniques/gl/context.h"
#include "tests/support/environment_scenes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace techniques;

std::unique_ptr<Technique> made(const std::string& name) {
    const Variant variant = parseVariant(name);
    return variant.entry->make(variant.parameters);
}

/// Of the slab's top.
double greatestError(const Stage& stage, const Image<float>& v) {
    double worst = 0;
    for (const SlabPoint& point : slabPoints(stage, v))
        worst = std::max(worst, std::abs(point.visibility - plateVisibility(point.at)));
    return worst;
}

TEST(PrtSh, UnderAConstantSkyIsExact) { // which the first coefficient alone holds
    const Scene scene = plateUnderSky();
    Stage stage(scene);
    stage.show(0);
    // What is left is of the points and of the rays.
    EXPECT_LE(greatestError(stage, rendered(stage, "prt-sh")), 0.01);
    EXPECT_LE(greatestError(stage, rendered(stage, "prt-sh:coefficients=4")), 0.01);
}

TEST(PrtSh, WithFewRaysErrsByThem) {
    const Scene scene = plateUnderSky();
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(greatestError(stage, rendered(stage, "prt-sh:directions=64")), 0.02);
}

TEST(PrtSh, ErrorFallsAsTheSunGrows) {
    std::vector<double> errors;
    for (const double diameter : {5.0, 20.0, 40.0}) {
        const Scene scene = edgeUnderSun(sunAlone(diameter));
        Stage stage(scene);
        stage.show(0);
        errors.push_back(sunRmsError(stage, "prt-sh"));
    }
    EXPECT_GT(errors[0], 1.1 * errors[1]);
    EXPECT_GT(errors[1], 1.1 * errors[2]);
    EXPECT_GT(errors[0], 0.1); // a small sun is not what five bands can hold
}

TEST(PrtSh, ErrorFallsWithTheNumberOfCoefficients) {
    const Scene scene = edgeUnderSun(sunAlone(40));
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(sunRmsError(stage, "prt-sh:coefficients=4"), sunRmsError(stage, "prt-sh:coefficients=9"));
    EXPECT_GT(sunRmsError(stage, "prt-sh:coefficients=9"), sunRmsError(stage, "prt-sh:coefficients=25"));
}

/// What a technique of few points and rays should give at each pixel, by rays and sums of the tests' own.
class TransferModel {
public:
    TransferModel(const Stage& stage, std::size_t budget, int directions, std::size_t coefficients)
        : points_(spreadPoints(stage.shown(), budget)), light_(harmonicLight(*stage.shown().light.environment)),
          coefficients_(coefficients) {
        const auto triangles = worldTriangles(stage.shown());
        const std::vector<DirectionSample> samples = evenSamples(directions);
        for (const SurfacePoint& point : points_.points) {
            double blocked = 0; // irradiance
            const std::vector<double> cosines = models::cosines(triangles, point, samples, 1.5e-4);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const double cosine = std::max(0.0, glm::dot(point.normal, glm::dvec3(samples[i].direction)));
                blocked += samples[i].solidAngle * (cosine - cosines[i]) * lightFrom(glm::dvec3(samples[i].direction));
            }
            irradiance_.push_back(unshadowed(point.normal) - blocked);
        }
    }

    [[nodiscard]] double visibility(std::size_t surface, const glm::dvec3& at, const glm::dvec3& normal) const {
        const PointPatch& patch = points_.patches[models::patchAt(points_, surface, at, normal)];
        return std::clamp(models::interpolated(points_, patch, at, irradiance_) / unshadowed(patch.normal), 0.0, 1.0);
    }

private:
    /// The band-limited light's radiance.
    [[nodiscard]] double lightFrom(const glm::dvec3& direction) const {
        const ShVector basis = shBasis(direction);
        double sum = 0;
        for (std::size_t i = 0; i < coefficients_; ++i) sum += light_.at(i) * basis.at(i);
        return sum;
    }

    [[nodiscard]] double unshadowed(const glm::dvec3& normal) const {
        const ShVector transfer = unshadowedTransfer(normal);
        double sum = 0;
        for (std::size_t i = 0; i < coefficients_; ++i) sum += light_.at(i) * transfer.at(i);
        return sum;
    }

    SurfacePoints points_;
    ShVector light_;
    std::size_t coefficients_;
    std::vector<double> irradiance_;
};

TEST(PrtSh, IsItsModel) {
    const Scene scene = under(boxScene(64), {ConstantSky{0.2}, {{glm::normalize(glm::dvec3(0.4, 0.8, -0.3)), 30, 3}}});
    Stage stage(scene);
    stage.show(0);
    for (const std::size_t coefficients : {9U, 25U}) {
        const TransferModel model(stage, 300, 256, coefficients);
        const Image<float> v =
            rendered(stage, fmt::format("prt-sh:points=300,directions=256,coefficients={}", coefficients));
        const metrics::Drawn drawn = stage.drawn();
        const Image<glm::vec3> normals = stage.normals();
        std::size_t compared = 0, differing = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (drawn.id[i] == 0) continue;
            ++compared;
            const double expected = model.visibility(drawn.id[i], glm::dvec3(drawn.position[i]), glm::dvec3(normals[i]));
            differing += std::abs(v[i] - expected) > 1e-4 ? 1 : 0; // a few sums of 32-bit floats
        }
        EXPECT_GT(compared, 2000U);
        EXPECT_LE(differing, compared / 100); // rays that graze an edge, and pixels on the edge of two triangles
    }
}

TEST(PrtSh, SeesNothingOfALightBeyondItsBands) {
    std::vector<double> low(49);
    low[0] = 3;
    low[5] = 0.2;
    std::vector<double> high = low;
    high[30] = 0.4; // of the sixth band
    high[45] = 0.3; // of the seventh
    std::vector<double> second = low;
    second[7] = 0.3; // of the third
    std::vector<Image<float>> images;
    for (const auto& coefficients : {low, high, second}) {
        const Scene scene = under(boxScene(64), {HarmonicSky{coefficients}, {}});
        Stage stage(scene);
        stage.show(0);
        images.push_back(rendered(stage, "prt-sh:points=2000,directions=256"));
    }
    EXPECT_EQ(images[0], images[1]);
    EXPECT_NE(images[0], images[2]);
}

/// What a frame under a light that stands still runs, and the bytes of textures and buffers that it has.
struct SteadyFrame {
    std::vector<std::string> passes; // "name × how often"
    std::uint64_t bytes;
};

SteadyFrame steadyUnder(int suns) {
    const Scene scene = under(plateUnderSky(), {ConstantSky{0.5}, manySuns(suns)});
    Stage stage(scene);
    stage.show(0);
    const std::uint64_t before = gl::Context::current().tally().bytes;
    const auto technique = made("prt-sh:points=4000,directions=256");
    for (int frame = 0; frame < 2; ++frame) stage.render(*technique, frame, 1);
    SteadyFrame result{{}, gl::Context::current().tally().bytes - before};
    for (const timing::PassCost& pass : timing::measurePasses(stage, *technique, 2, 1, 1).passes)
        result.passes.push_back(fmt::format("{} × {} with {} fragments", pass.name, pass.work.passes, pass.work.fragments));
    return result;
}

TEST(PrtSh, CostsTheSameUnderAnyNumberOfSuns) { // K40
    // The frame does not meet the light, whose suns are one projection's; nor does it read more than one light's worth.
    const SteadyFrame one = steadyUnder(1), sixteen = steadyUnder(16);
    EXPECT_EQ(one.passes.size(), 3U); // G-buffer, dot products, lookup: no projection
    EXPECT_EQ(one.passes, sixteen.passes);
    EXPECT_EQ(one.bytes, sixteen.bytes);
}

TEST(PrtSh, PrecomputesOnceAndProjectsALightWhenItChanges) {
    const Scene noon = plateUnderSky();
    const Scene evening = under(noon, {ConstantSky{0.1}, {{glm::normalize(glm::dvec3(1, 0.4, 0)), 20, 5}}});
    Stage first(noon), second(evening);
    first.show(0);
    second.show(0);
    const auto technique = made("prt-sh:points=4000,directions=256");
    const auto passes = [&](Stage& stage) {
        std::vector<std::string> names;
        struct Names final : PassListener {
            explicit Names(std::vector<std::string>& into) : into_(into) {}
            void begin(std::string_view pass) override { into_.emplace_back(pass); }
            void end(std::string_view) override {}
            std::vector<std::string>& into_;
        } listener(names);
        stage.render(*technique, 0, 1, &listener);
        return names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(passes(first), (Names{"precomputation", "light projection", "dot products", "lookup"}));
    EXPECT_EQ(passes(first), (Names{"dot products", "lookup"}));
    const Image<float> atNoon = first.visibility();
    EXPECT_EQ(passes(second), (Names{"light projection", "dot products", "lookup"})); // the same surfaces, another light
    EXPECT_NE(second.visibility(), atNoon);
    EXPECT_EQ(second.visibility(), rendered(second, "prt-sh:points=4000,directions=256"));
}

TEST(PrtSh, CompressionTradesErrorForBytes) {
    const Scene scene = plateUnderSky();
    Stage stage(scene);
    stage.show(0);
    const std::string few = "prt-sh:points=8000,directions=512";
    const Image<float> plain = rendered(stage, few);
    const auto bytes = figuresOf(stage, few);
    const std::size_t triangles = 24;
    EXPECT_EQ(bytes.at("transfer_bytes"), 4 * 25 * (bytes.at("points") + triangles));
    EXPECT_EQ(bytes.at("compression_error"), 0);
    double before = 1;
    for (const int components : {1, 3, 25}) {
        const std::string variant = fmt::format("{},compression=clustered,clusters=64,components={}", few, components);
        const auto figures = figuresOf(stage, variant);
        EXPECT_LT(figures.at("compression_error"), before);
        before = figures.at("compression_error");
        if (components < 25) {
            EXPECT_LT(figures.at("transfer_bytes"), 0.3 * bytes.at("transfer_bytes"));
        }
        double worst = 0;
        const Image<float> v = rendered(stage, variant);
        for (std::size_t i = 0; i < v.size(); ++i) worst = std::max(worst, std::abs(static_cast<double>(v[i] - plain[i])));
        EXPECT_LE(worst, components == 25 ? 1e-4 : components == 3 ? 0.05 : 0.5); // all components: nothing is lost
    }
}

TEST(PrtSh, EachSideOfAnOpenMeshHasItsOwnTransfer) {
    Scene scene = groundScene(64);
    const Mesh sheet{{{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}, {{0, 1, 2}, {0, 2, 3}}, false};
    scene.objects.clear();
    scene.objects.push_back(object(sheet, {0, 1, 0}));
    scene.objects.push_back(object(box({40, 0.1, 40}), {0, 1.5, 0}));
    scene = under(scene, {ConstantSky{1}, {}});
    for (const double eye : {-3.0, 1.4}) { // below the sheet, and between it and the roof
        scene.camera = {{0.1, eye, 0.3}, {0.1, 1, 0.2}, {0, 0, 1}, 20, 0.1, 40};
        Stage stage(scene);
        stage.show(0);
        const Image<float> v = rendered(stage, "prt-sh:points=2000,directions=256");
        const metrics::Drawn drawn = stage.drawn();
        std::size_t seen = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (drawn.id[i] != 1) continue;
            ++seen;
            EXPECT_NEAR(v[i], eye < 0 ? 1 : 0, 0.01);
        }
        EXPECT_GT(seen, 500U);
    }
}

TEST(PrtSh, TheGroundBesideAWallIsNotDarkenedByWhatIsInsideIt) {
    Scene scene = groundScene(96);
    scene.objects.push_back(object(box({0.6, 1.2, 40}), {-0.3, 0.57, 0})); // sunk into the slab
    scene.camera = {{1.2, 1.6, 0.4}, {0.4, 0, 0.1}, {0, 1, 0}, 40, 0.1, 40};
    scene = under(scene, {ConstantSky{1}, {}});
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, "prt-sh");
    const metrics::Drawn drawn = stage.drawn();
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p(drawn.position[i]);
        if (drawn.id[i] != 1 || p.y < -0.001 || p.x < 0.005 || p.x > 0.15 || std::abs(p.z) > 1) continue;
        const double elevation = std::atan2(1.17, p.x); // of the wall's top: the wall is as good as endless
        sum += v[i] - 0.5 * (1 + std::cos(elevation));
        ++count;
    }
    ASSERT_GT(count, 100U);
    EXPECT_NEAR(sum / static_cast<double>(count), 0, 0.02); // black points under the wall would take a quarter away
}

TEST(PrtSh, IsForEnvironmentLightAndSurfacesThatStandStill) {
    const Variant variant = parseVariant("prt-sh");
    EXPECT_EQ(variant.entry->environment, EnvironmentAnswer::Only);
    Scene scene = plateUnderSky();
    EXPECT_FALSE(variant.entry->notApplicable(scene));
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {4, {1, 0, 0}}};
    EXPECT_EQ(variant.entry->notApplicable(scene),
              "precomputes the transfer of surfaces that stand still; in test one moves");
    EXPECT_THROW(parseVariant("prt-sh:coefficients=24"), BadInput);
    EXPECT_THROW(parseVariant("prt-sh:points=10"), BadInput);
    EXPECT_THROW(parseVariant("prt-sh:clusters=0"), BadInput);
}

} // namespace
} // namespace shadowbench
